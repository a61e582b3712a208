"""Distances from the catalogue: a ring where a scheme does the same, a dot where it does not, and the line between."""

from __future__ import annotations

from math import inf

import pytest

from reference.errors import InputError
from reference.identification.result import Identification, Match
from report.figures.identification import FLOOR, draw
from tests.report.figures.artists import data, marks, words

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
    assert "named up to here" in "".join(words(axes))


def test_nothing_compared_is_no_figure() -> None:
    """It says why there is nothing."""
    with pytest.raises(InputError, match="it crashed"):
        draw(Identification("mine", (), 1e-12, "it crashed"))
