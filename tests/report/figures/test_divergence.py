"""Engines over time: full markers are distances from the true motion, hollow ones from the scheme."""

from __future__ import annotations

from dataclasses import replace

import pytest

from report.figures import COLOURS, draw
from report.figures.divergence import FLOOR
from tests.experiments.canned import divergence
from tests.experiments.canned.reading import records
from tests.report.figures.artists import data, marks, text, tick_labels, words
from tests.report.figures.shown import result, shown


def test_lines_are_the_tables_and_full_is_measured() -> None:
    """One line for the distance from the true motion, one for that from the scheme where there is one."""
    axes = shown("divergence").figure.axes[0]
    table = records(result("divergence"), "divergence_over_time")
    measured, identified = marks(axes, linestyle="-", fillstyle="full"), marks(axes, linestyle="--", fillstyle="none")
    by_name = {name: [row for row in table if row["stepper"] == name] for name in ("KickDrift", "StifferByAMillionth")}
    for line, rows in zip(measured, by_name.values(), strict=True):
        times, errors = data(line)
        assert times == [row["time [s]"] for row in rows]
        assert errors == [max(row["error [m]"], FLOOR) for row in rows]
    (ring,) = identified
    assert data(ring)[1] == [max(row["deviation [m]"], FLOOR) for row in by_name["KickDrift"]]
    assert ring.get_color() == measured[0].get_color() != measured[1].get_color()
    starts, steps = zip(*(line.get_markevery() for line in measured), strict=True)
    assert set(steps) == {len(data(measured[0])[0]) // 6}
    assert 0 < starts[0] < starts[1] <= steps[0]  # their markers are not over one another


def test_it_is_as_high_as_its_labels_need_and_no_higher() -> None:
    """At least 5.8 inches; one line of a label is a sixth of an inch."""
    many = draw("divergence", divergence.of(*(divergence.ran(f"no_{i}", None, 1e-4 * (i + 1)) for i in range(25))))
    for figure in (shown("divergence").figure, many.figure):
        labels = [said for said in words(figure.axes[0]) if "true motion" not in said and "scheme named" not in said]
        lines = sum(1 + said.count("\n") for said in labels)
        assert max(5.8, 0.16 * lines) <= figure.get_figheight() <= max(5.8, 0.17 * (lines + 4) + 1e-9)


def test_axes_have_units_and_zero_is_none() -> None:
    """Logarithmic in metres, over the whole time."""
    axes = shown("divergence").figure.axes[0]
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("time [s]", "largest distance of any mass [m]")
    assert (axes.get_xscale(), axes.get_yscale()) == ("linear", "log")
    assert tick_labels(axes.yaxis)[FLOOR] == "none"
    assert axes.get_xlim() == pytest.approx((0, divergence.SETUP.duration))


def test_labels_name_the_scheme_and_who_is_it_at_the_end_of_their_line() -> None:
    """In the line's colour; engines that are one scheme have one line, the largest of theirs."""
    near, far = divergence.ran("a", "rk4", 1e-8), divergence.ran("b", "rk4", 3e-8, deviation=5e-15)
    axes = draw("divergence", divergence.of(near, far, divergence.ran("c", None, 2e-3))).figure.axes[0]
    rk4, stranger = text(axes, "rk4:\na, b"), text(axes, "not identified:\nc")
    assert (rk4.xy, stranger.xy) == (pytest.approx((0.02, 3e-8)), pytest.approx((0.02, 2e-3)))
    assert (rk4.arrowprops["color"], stranger.arrowprops["color"]) == COLOURS[:2]
    (deviation,) = marks(axes, fillstyle="none")
    assert data(deviation)[1][-1] == pytest.approx(5e-15)


def test_a_line_ends_where_the_first_of_its_engines_does() -> None:
    """Beyond, there is no largest of all; its label is at that end."""
    whole, broken = divergence.ran("a", "rk4", 1e-8), divergence.ran("b", "rk4", 3e-8)
    assert broken.error is not None
    broken = replace(broken, error=broken.error[:11], deviation=broken.error[:11])
    axes = draw("divergence", divergence.of(whole, broken)).figure.axes[0]
    (measured,) = marks(axes, linestyle="-")
    times, errors = data(measured)
    assert (len(times), times[-1], errors[-1]) == (11, pytest.approx(0.01), pytest.approx(1.5e-8))
    assert text(axes, "a, b").xy == pytest.approx((0.01, 1.5e-8))


def test_words_say_which_is_which() -> None:
    """Measured above, identified below."""
    axes = shown("divergence").figure.axes[0]
    measured, identified = text(axes, "measured: "), text(axes, "identified: ")
    assert "true motion (full" in measured.get_text()
    assert "scheme" in identified.get_text()
    assert "(hollow" in identified.get_text()
    assert measured.get_position()[1] > 1e-3 > 1e-11 > identified.get_position()[1]


def test_what_is_beyond_the_axis_makes_it_longer() -> None:
    """Nothing is drawn at another place than its own."""
    axes = draw("divergence", divergence.of(divergence.ran("wild", None, 300.0))).figure.axes[0]
    assert data(axes.lines[0])[1][-1] == 300.0
    assert axes.get_ylim()[1] > 300


def test_the_words_for_it_name_engines_schemes_and_strangers() -> None:
    """As the figure does; an engine that did not run is not in it."""
    alt = shown("divergence").alt
    assert "KickDrift: up to 4.0e-03 m from the true motion, 2.0e-15 m from kick_drift" in alt
    assert "StifferByAMillionth: up to 2.0e-03 m from the true motion, not identified" in alt
    assert "Segfaults" not in alt


def test_a_users_scene_is_drawn_in_the_same_way() -> None:
    """The question of the motion there is that of the string here."""
    assert words(shown("motion").figure.axes[0]) == words(shown("divergence").figure.axes[0])
