"""Distance from the pendulum by stiffness: dots are measured, squares on them the cable's, dotted is predicted."""

from __future__ import annotations

import numpy as np
import pytest

from report.figures import COLOURS
from tests.experiments.canned.reading import records
from tests.experiments.canned.stiff_limit import STIFFNESSES
from tests.report.figures.artists import data, marks, text
from tests.report.figures.shown import result, shown


def test_markers_are_the_table() -> None:
    """Large dots to the pendulum, squares to the cable, each in the colour of its words."""
    axes = shown("stiff_limit").figure.axes[0]
    table = records(result("stiff_limit"))
    for marker, column, words in (
        ("o", "string to pendulum [m]", "to the pendulum"),
        ("s", "string to MuJoCo cable [m]", "to MuJoCo's cable"),
    ):
        (found,) = marks(axes, marker=marker)
        assert data(found) == ([row["stiffness [N/m]"] for row in table], [row[column] for row in table])
        assert found.get_color() == text(axes, words).get_color()
        assert text(axes, words).get_text().startswith("measured: ")
        assert text(axes, words).xy in list(zip(*data(marks(axes, marker="o")[0]), strict=True))
    (dots,), (squares,) = marks(axes, marker="o"), marks(axes, marker="s")
    assert dots.get_markersize() > squares.get_markersize()
    assert (dots.get_color(), squares.get_color()) == COLOURS[:2]


def test_the_dotted_line_falls_as_one_over_the_stiffness_through_the_last_dot() -> None:
    """Predicted, and said to be."""
    axes = shown("stiff_limit").figure.axes[0]
    (dotted,) = marks(axes, linestyle=":")
    stiffness, distance = data(dotted)
    assert np.array(distance) * stiffness == pytest.approx(np.full(5, 100.0))
    said = text(axes, "predicted: 1/stiffness")
    assert said.get_color() == dotted.get_color()
    assert said.xy[0] * said.xy[1] == pytest.approx(100.0)
    assert min(stiffness) < said.xy[0] < max(stiffness)


def test_axes_have_units_and_are_logarithmic() -> None:
    """Both."""
    axes = shown("stiff_limit").figure.axes[0]
    assert axes.get_xlabel() == "stiffness of the springs [N/m]"
    assert axes.get_ylabel() == "largest distance within 0.5 s [m]"
    assert (axes.get_xscale(), axes.get_yscale()) == ("log", "log")


def test_without_the_cable_there_are_no_squares_and_the_words_have_the_distances() -> None:
    """Not a number is no place."""
    (squares,) = marks(shown("stiff_limit", "no engine").figure.axes[0], marker="s")
    assert np.isnan(data(squares)[1]).all()
    for k in STIFFNESSES:
        assert f"{100 / k:.2g} m at {k:g} N/m" in shown("stiff_limit").alt
