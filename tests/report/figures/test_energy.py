"""Energies over time in the colours of what was measured of them; momenta as dots, angular momenta as diamonds."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb

from experiments.energy import DURATION, result_of
from reference.stepper import catalogued
from report.figures import COLOURS
from report.figures.energy import FLOOR, HIGHEST, LOOKS, LOWEST, SPANS, draw
from tests.experiments.canned import energy
from tests.experiments.canned.reading import records
from tests.experiments.canned.steppers import Named
from tests.report.figures.artists import data, marks, text, tick_labels, verticals, words
from tests.report.figures.shown import result, shown


def above() -> Axes:
    """Energies."""
    return shown("energy").figure.axes[0]


def below() -> Axes:
    """Momenta."""
    return shown("energy").figure.axes[1]


def largest(name: str) -> list[float]:
    """The largest error in each span, of all its times, 25 of them."""
    (errors,) = [np.abs(row.errors) for row in result("energy").data["rows"] if row.stepper.name == name]
    return [errors[i * 25 : (i + 1) * 25].max() for i in range(SPANS - 1)] + [errors[(SPANS - 1) * 25 :].max()]


def test_lines_are_the_largest_errors_of_each_second() -> None:
    """Of one that stands for all that do the same; at the span's end."""
    by_end = {data(line)[1][-1]: line for line in marks(above()) if line.get_color() != "#000000"}
    for name in ("kick_drift", "rk4", "pendulum_kick_drift", "heun_link_by_link"):
        line = by_end[largest(name)[-1]]
        assert data(line) == (
            pytest.approx([DURATION / SPANS * (i + 1) for i in range(SPANS)]),
            pytest.approx(np.clip(largest(name), LOWEST, HIGHEST)),
        )


def test_colour_and_marker_are_of_the_measured_kind_dashes_of_constraints() -> None:
    """The rod's pendulum was predicted bounded, and grows: it has the colour of what grows."""
    ends = {
        name: energy.errors(kind, size)[-50:]
        for name, kind, size in (("rk4", "decaying", 1.0), ("pendulum", "growing", 0.1))
    }
    for name, style in (("rk4", "-"), ("pendulum", "--")):
        (line,) = [
            m for m in marks(above(), linestyle=style) if data(m)[1][-1] == pytest.approx(np.abs(ends[name]).max())
        ]
        kind = "decaying" if name == "rk4" else "growing"
        assert (line.get_color(), line.get_marker()) == (LOOKS[kind]["color"], LOOKS[kind]["marker"])
    assert len({tuple(look.values()) for look in LOOKS.values()}) == len(LOOKS)
    assert "dashed: distance constraints" in above().get_title(loc="left")
    warm, cold = (to_rgb(LOOKS[kind]["color"]) for kind in ("growing", "decaying"))
    assert warm[0] - warm[2] > 0.5 < cold[2] - cold[0]


def test_rings_are_on_lines_of_engines() -> None:
    """On kick_drift's, which pymunk_springs is; on no other."""
    (ring,) = marks(above(), marker="o", fillstyle="none")
    assert data(ring)[1] == pytest.approx(largest("kick_drift"))
    assert text(above(), "kick_drift, 1 engine: bounded")


def test_of_those_that_are_alike_the_first_is_drawn() -> None:
    """With its errors, times, constraints and end, whatever the last is: one line stands for both."""
    first = energy.row("rk4", "decaying", "decaying")
    torn = energy.torn()
    last = replace(torn, alike="rk4", measured="decaying", scheme=catalogued()["pendulum_rk4"])
    for one, other, style, end in ((first, last, "-", DURATION), (last, first, "--", energy.TORN)):
        axes = draw(result_of([one, other])).figure.axes[0]
        (line,) = marks(axes)
        assert (line.get_linestyle(), data(line)[0][-1]) == (style, end)
        assert data(line)[1][-1] == pytest.approx(np.abs(one.errors).max())
        (said,) = axes.texts
        assert said.get_text().startswith(f"{one.stepper.name}, 1 scheme: decaying")
        assert ("diverged" in said.get_text()) == (one is last)


def test_labels_say_what_was_measured_and_what_was_predicted_where_it_is_not_that() -> None:
    """At the end of the line; one that diverged says when."""
    odd = text(above(), "pendulum_kick_drift: growing (predicted bounded)")
    assert odd.xy == (pytest.approx(DURATION), pytest.approx(0.1 * energy.LARGEST["growing"]))
    assert not [said for said in words(above()) if "predicted" in said and "pendulum" not in said]
    diverged = text(above(), "diverged at 4 s")
    assert diverged.get_text().startswith("euler: growing")
    assert diverged.xy == (pytest.approx(energy.TORN), pytest.approx(100.0))


def test_labels_of_those_that_diverged_are_to_the_right_of_all_their_ends() -> None:
    """One tears at 4 s, another at half of that: a label further left would lie over the longer line."""
    late = energy.torn()
    many = late.times <= energy.TORN / 2
    early = replace(late, stepper=Named("tears_early"), alike=None, times=late.times[many], errors=late.errors[many])
    axes = draw(result_of([*energy.rows(), early])).figure.axes[0]
    labels = [text(axes, f"diverged at {time:g} s") for time in (energy.TORN, energy.TORN / 2)]
    assert all(label.get_position()[0] > energy.TORN / DURATION for label in labels)


def test_axes_have_units_and_what_is_beyond_them_is_said() -> None:
    """Both logarithmic in what is not time."""
    assert (above().get_xlabel(), above().get_yscale(), above().get_xlim()) == ("time [s]", "log", (0, DURATION))
    assert above().get_ylabel().startswith("largest energy error in a second [1]")
    labels = tick_labels(above().yaxis)
    assert "or less" in labels[LOWEST]
    assert "or more" in labels[HIGHEST]
    between = {place: text for place, text in labels.items() if LOWEST < place < HIGHEST}
    assert between == {10.0**n: f"$10^{{{n}}}$" for n in (-7, -5, -3, -1, 1, 3)}
    assert below().get_xlabel().startswith("largest error [1]: dots, of momentum")
    assert "diamonds, of angular momentum" in below().get_xlabel()
    assert below().get_xscale() == "log"
    assert tick_labels(below().xaxis)[FLOOR] == "none"


def test_dots_are_momenta_and_diamonds_angular_momenta() -> None:
    """Of all that flew, as the table has them."""
    table = [row for row in records(result("energy")) if row["momentum [1]"] is not None]
    assert [*tick_labels(below().yaxis).values()] == [row["stepper"] for row in table]
    dots, diamonds = marks(below(), marker="o", color=COLOURS[6]), marks(below(), marker="D")
    assert [data(dot) for dot in dots] == [([row["momentum [1]"]], [i]) for i, row in enumerate(table)]
    assert [data(diamond) for diamond in diamonds] == [([row["angular [1]"]], [i]) for i, row in enumerate(table)]
    assert verticals(below()) == [result("energy").data["rounding"]]
    assert text(below(), "rounding up to here").get_position()[0] == result("energy").data["rounding"]


def test_the_words_for_it_name_the_kinds() -> None:
    """And the momenta."""
    alt = shown("energy").alt
    assert "bounded: kick_drift, pymunk_springs; growing: pendulum_kick_drift, heun_link_by_link, euler" in alt
    assert "decaying: rk4" in alt
    assert "heun_link_by_link 3e-02 and 4e-02" in alt
