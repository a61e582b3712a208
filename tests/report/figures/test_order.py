"""Error against dt: lines are schemes, black rings engines, dotted lines the slopes to compare with."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.axes import Axes

from experiments.order import DTS, DURATION, result_of
from report.figures import draw
from report.figures.order import SLOPES
from tests.experiments.canned.order import row, rows, stranger
from tests.experiments.canned.reading import numbers, records
from tests.report.figures.artists import data, laid_out, marks, tick_labels, words
from tests.report.figures.shown import result, shown


def panels() -> list[Axes]:
    """Schemes, in place, engines, and with distance constraints."""
    return shown("order").figure.axes


def errors(name: str) -> list[float]:
    """Of a stepper, as the table has them [m]."""
    return [row["error [m]"] for row in records(result("order"), "order_errors") if row["stepper"] == name]


def test_each_is_in_its_family_with_the_errors_of_the_table() -> None:
    """Schemes as lines, engines as rings on them."""
    families = [
        (["kick_drift", "heun", "rk4", "velocity_verlet"], []),
        (["euler_in_place"], []),
        (["kick_drift"], ["pymunk_springs", "stranger", "Segfaults"]),
        (["pendulum_rk4"], ["mujoco_cable_rk4"]),
    ]
    for axes, (schemes, engines) in zip(panels(), families, strict=True):
        drawn = marks(axes, linestyle="-")
        assert [data(line)[0] for line in drawn] == [DTS.tolist()] * len(schemes)
        assert [data(line)[1] for line in drawn] == [errors(name) for name in schemes]
        rings = marks(axes, marker="o", fillstyle="none", color="#000000")
        drawn_errors = [[None if np.isnan(e) else e for e in data(ring)[1]] for ring in rings]
        assert drawn_errors == [errors(name) for name in engines]


def test_dotted_lines_have_the_slopes_they_say() -> None:
    """In every panel, by their ends."""
    for axes in panels():
        dotted = marks(axes, linestyle=":")
        found = [np.log(y[0] / y[-1]) / np.log(x[0] / x[-1]) for x, y in map(data, dotted)]
        assert found == pytest.approx([*SLOPES])
        said = [numbers(text)[0] for text in words(axes) if text.startswith("slope")]
        assert said == [*SLOPES]
        for text, line in zip((t for t in axes.texts if t.get_text().startswith("slope")), dotted, strict=True):
            assert text.xy in list(zip(*data(line), strict=True))


def test_labels_have_the_measured_slopes_and_the_engines() -> None:
    """Each at its line's end; those that end together in one."""
    schemes, in_place, engines, constrained = (
        {text.get_text(): text.xy for text in axes.texts if not text.get_text().startswith("slope")}
        for axes in panels()
    )
    assert {text: xy[1] for text, xy in schemes.items()} == pytest.approx(
        {"kick_drift 1.00": 1e-3, "heun 2.00\nvelocity_verlet 1.50": 1e-5, "rk4 4.00": 1e-7}
    )
    assert [*in_place] == ["euler_in_place 1.00"]
    assert {*engines} == {"kick_drift 1.00\n   o pymunk_springs", "stranger no slope"}
    assert [*constrained] == ["pendulum_rk4 4.00\n   o mujoco_cable_rk4"]
    assert {xy[0] for xy in schemes.values()} == {DTS[0]}


def test_axes_have_units_and_both_are_logarithmic() -> None:
    """Shared by all panels, and labelled at the edges."""
    above, _, below, right = panels()
    assert above.get_ylabel() == below.get_ylabel() == f"error after {DURATION:g} s [m]"
    assert below.get_xlabel() == right.get_xlabel() == "dt [s]"
    assert {(axes.get_xscale(), axes.get_yscale()) for axes in panels()} == {("log", "log")}
    assert "rings" in panels()[2].get_title(loc="left")


def test_the_words_for_it_have_the_slopes() -> None:
    """Of who has one."""
    for one in rows():
        if one.slope is not None:
            assert f"{one.stepper.name} {one.slope:.2f}" in shown("order").alt
    assert "stranger" not in shown("order").alt


def test_panels_share_their_axes_and_leave_room_beside_the_ends() -> None:
    """From the smallest dt to the largest, a little further; labels stand outside, once each."""
    axes = np.array(laid_out(shown("order").figure).axes).reshape(2, 2)
    for panel in axes.flat:
        left, right = panel.get_xlim()
        assert left < DTS.min() < DTS.max() < right
        assert right / left < 2 * DTS.max() / DTS.min()
    assert len({(panel.get_xlim(), panel.get_ylim()) for panel in axes.flat}) == 1
    shown_labels = [(bool(tick_labels(p.xaxis)), bool(tick_labels(p.yaxis))) for p in axes.flat]
    assert shown_labels == [(False, True), (False, False), (True, True), (True, False)]


def test_an_engine_that_is_no_scheme_has_its_label_at_its_own_end() -> None:
    """At the largest dt, in black."""
    (label,) = [text for text in panels()[2].texts if "stranger" in text.get_text()]
    assert label.xy == (DTS[0], errors("stranger")[0])


def test_what_has_no_error_at_the_largest_dt_has_no_label() -> None:
    """Its line would have no end there; one that has none at the smallest has."""
    for index, kept in ((-1, True), (0, False)):
        without = [replace(one, errors=one.errors.copy()) for one in (row("rk4"), stranger())]
        for one in without:
            one.errors[index] = np.nan
        schemes, _, engines, _ = draw("order", result_of(without)).figure.axes
        for axes, label in ((schemes, "rk4"), (engines, "stranger")):
            assert [said.split()[0] for said in words(axes) if not said.startswith("slope")] == [label] * kept
