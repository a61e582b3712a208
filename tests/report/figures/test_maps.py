"""Maps: colours are measured growth on one scale, black is the predicted limit, dt is to the right."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.colors import SymLogNorm
from matplotlib.contour import ContourSet

from report.figures import BLACK_ON_COLOURS
from report.figures.stability_map import MOST, draw_map, words
from tests.experiments.canned.maps import field, plane
from tests.report.figures.artists import data
from tests.report.figures.shown import result, shown


def mesh(axes: Axes) -> Any:
    """What the colours are of."""
    return axes.collections[0]


def test_each_map_has_its_panel_with_its_own_axes() -> None:
    """Dt in seconds, the other in its unit, both as far as they were measured."""
    *panels, _ = shown("maps").figure.axes
    for axes, found in zip(panels, result("maps").data["maps"], strict=True):
        assert axes.get_xlabel() == "dt [s]"
        assert axes.get_ylabel() == f"{found.y.name} [N s/m]"
        assert axes.get_xlim() == pytest.approx((found.x.low, found.x.high))
        assert axes.get_ylim() == pytest.approx((found.y.low, found.y.high))
        assert axes.get_title(loc="left") == f"{found.stepper}\nblack: predicted limit of\n{found.predicted_by}"


def test_colours_are_the_growth_and_the_line_the_prediction() -> None:
    """Clipped at the ends of the scale, which say so; red grows."""
    *panels, bar = shown("maps").figure.axes
    for axes, found in zip(panels, result("maps").data["maps"], strict=True):
        shown_growth = np.asarray(mesh(axes).get_array()).reshape(found.growth.shape)
        assert np.array_equal(shown_growth, np.clip(found.growth, -MOST, MOST))
        (line,) = axes.lines
        assert np.array_equal(np.array(data(line)).T, found.boundary)
        assert line.get_color() == BLACK_ON_COLOURS
        colours = mesh(axes)
        assert isinstance(colours.norm, SymLogNorm)
        assert colours.get_rasterized()  # else every cell is a shape of its own in the file
        assert (colours.norm.vmin, colours.norm.vmax) == (-MOST, MOST)
        red, _, blue, _ = colours.cmap(colours.norm(MOST))
        assert red > 2 * blue
    assert bar.get_ylabel() == "measured growth in a step [1]"
    labels = dict(zip(bar.get_yticks(), (label.get_text() for label in bar.get_yticklabels()), strict=True))
    assert labels == {
        -0.05: "-5 % or less",
        -0.01: "-1 %",
        -0.001: "-0.1 %",
        0.0: "0",
        0.001: "0.1 %",
        0.01: "1 %",
        0.05: "5 % or more",
    }


def test_growth_is_at_its_place() -> None:
    """The cell at a large dt and small drag has the growth measured there; x and y are not each other's."""
    found = field()
    growth = found.growth.copy()
    growth[0, -1] = 0.04
    axes = draw_map(type(found)(**{**vars(found), "growth": growth})).figure.axes[0]
    corners = np.asarray(mesh(axes).get_coordinates())
    middle = corners[:2, -2:].mean(axis=(0, 1))
    assert middle == pytest.approx([found.x_values[-1], found.y_values[0]])
    assert np.asarray(mesh(axes).get_array()).reshape(growth.shape)[0, -1] == 0.04


def test_where_no_axis_is_dt_the_line_is_where_the_limit_is_the_dt() -> None:
    """The contour at 1 of the largest stable dt over dt: 0.5 N s/m here. Masses are counted."""
    axes = draw_map(plane()).figure.axes[0]
    (limit,) = [c for c in axes.get_children() if isinstance(c, ContourSet)]
    assert limit.levels.tolist() == [1.0]
    (path,) = limit.get_paths()
    assert path.vertices[:, 1] == pytest.approx(np.full(len(path.vertices), 0.5))
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("masses [1]", "drag [N s/m]")


@pytest.mark.parametrize(("factor", "word"), [(100.0, "stable"), (0.01, "unstable")])
def test_where_the_limit_is_not_on_the_plane_no_line_is_promised(factor: float, word: str) -> None:
    """All of it is on one side; Matplotlib's warning of a contour without a line would fail this test."""
    found = plane()
    assert found.predicted_limit is not None
    xs, ys, limit = found.predicted_limit
    beside = type(found)(**{**vars(found), "predicted_limit": (xs, ys, factor * (limit + 0.1))})
    axes = draw_map(beside).figure.axes[0]
    assert not [c for c in axes.get_children() if isinstance(c, ContourSet)]
    title = axes.get_title(loc="left")
    assert f"predicted to be {word} on all" in title
    assert "black" not in title


def test_an_axis_of_one_value_is_drawn() -> None:
    """As masses from 2 to 2.4 are; there is no warning of limits that are the same."""
    found = field()
    one = {"y_values": found.y_values[:1], "growth": found.growth[:1], "boundary": found.boundary[:1]}
    draw_map(type(found)(**{**vars(found), **one}))


def test_without_a_limit_the_title_says_so() -> None:
    """No line."""
    found = field()
    axes = draw_map(type(found)(**{**vars(found), "boundary": np.empty((0, 2))})).figure.axes[0]
    assert axes.get_title(loc="left").startswith("heun\nheun: predicted to have no limit here")
    assert not axes.lines


def test_the_words_for_a_map_have_the_part_that_is_stable() -> None:
    """Half of the plane."""
    assert words(field()) == "Map of growth over dt and drag for heun: 50% of it is stable."
    assert words(field()) in shown("maps").alt
