"""Distances from the catalogue: a ring where a scheme does the same, a dot where it does not, and the line between."""

from __future__ import annotations

from math import inf

import pytest

from reference.errors import InputError
from reference.identification.result import Identification, Match
from report.figures import COLOURS
from report.figures.identification import FLOOR, draw
from tests.report.figures.artists import data, marks, text

FOUND = Identification(
    "mine",
    (Match("heun", 0.0), Match("ralston", 0.0, 3e-17), Match("rk4", 2e-4, 1e-4), Match("euler", inf)),
    1e-12,
)


def test_marks_are_the_distances_from_none_to_one_without_bounds() -> None:
    """None stands at the left end; what has left all bounds at ten times the largest that is a number."""
    axes = draw(FOUND).figure.axes[0]
    rings, dots = marks(axes, fillstyle="none"), marks(axes, fillstyle="full")
    assert [data(ring) for ring in rings] == [([FLOOR], [0]), ([3e-17], [1])]
    assert [data(dot)[0] for dot in dots] == [[2e-4], [pytest.approx(2e-3)]]
    assert {ring.get_color() for ring in rings}.isdisjoint({dot.get_color() for dot in dots})
    assert [label.get_text() for label in axes.get_yticklabels()] == ["heun", "ralston", "rk4", "euler"]


def test_the_axis_has_a_unit_and_holds_everything_and_the_line_is_the_tolerance() -> None:
    """Logarithmic, nearest above."""
    axes = draw(FOUND).figure.axes[0]
    assert axes.get_xlabel() == "largest distance [m]"
    assert axes.get_xscale() == "log"
    low, high = axes.get_xlim()
    assert low < FLOOR < 2e-3 < high
    assert axes.get_ylim()[0] > axes.get_ylim()[1]
    (line,) = [line for line in axes.lines if line.get_linestyle() == "--"]
    assert set(line.get_xdata()) == {1e-12}
    assert text(axes, "named up to here").xy == (1e-12, -0.75)  # type: ignore[attr-defined]


def test_rings_are_green_and_dots_are_not() -> None:
    """As what is identified and what is measured in all figures; the same to the tolerance is a ring."""
    at_the_border = Identification("mine", (Match("heun", 1e-12), Match("rk4", 1.1e-12)), 1e-12)
    axes = draw(at_the_border).figure.axes[0]
    ring, dot = marks(axes, marker="o")
    assert (ring.get_fillstyle(), ring.get_color()) == ("none", COLOURS[2])
    assert (dot.get_fillstyle(), dot.get_color()) == ("full", COLOURS[1])


def test_single_steps_are_said_to_be_that() -> None:
    """With their unit; a tolerance below all that is drawn stands at the left end."""
    stepwise = Identification("mine", (Match("heun", 0.0),), 1e-30, compared="single steps")
    axes = draw(stepwise).figure.axes[0]
    assert axes.get_xlabel() == "largest distance in a step [m]"
    (line,) = [line for line in axes.lines if line.get_linestyle() == "--"]
    assert set(line.get_xdata()) == {FLOOR} == {text(axes, "named up to here").xy[0]}  # type: ignore[attr-defined]


def test_no_more_than_fifteen_are_drawn_and_what_left_all_bounds_is_somewhere() -> None:
    """The nearest; where nothing is a number, at ten metres; where all is nothing, at one."""
    many = Identification("mine", tuple(Match(f"s{i}", 1e-3 * (i + 1)) for i in range(16)), 1e-12)
    axes = draw(many).figure.axes[0]
    assert [label.get_text() for label in axes.get_yticklabels()] == [f"s{i}" for i in range(15)]
    for errors, places in (((inf, inf), [10.0, 10.0]), ((0.0, inf), [FLOOR, 1.0])):
        found = Identification("mine", tuple(Match(f"s{i}", error) for i, error in enumerate(errors)), 1e-12)
        drawn = draw(found).figure.axes[0]
        assert [data(mark)[0][0] for mark in marks(drawn, marker="o")] == places
        assert drawn.get_xlim()[1] > max(places)


def test_nothing_compared_is_no_figure() -> None:
    """It says why there is nothing."""
    with pytest.raises(InputError, match="it crashed"):
        draw(Identification("mine", (), 1e-12, "it crashed"))
