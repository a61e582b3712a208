"""Where the camera is: everything is in the picture, as large as it can be."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest

from reference.obstacles import Circle, Obstacle, Plane
from reference.state import Array
from reference.system import MassSpringSystem
from report.live.framing import FILLED, TOWARDS, Window, box, camera, side_by_side
from report.live.scenes import names, open_scene

WINDOWS = (Window(1.3, 0.7), Window(1.3, 1.6), Window(1.3, 0.5, covered=0.6))


def seen(points: Array, place: Array, target: Array, window: Window) -> Array:
    """Where points are in the picture, from -1 to 1 across and up, shape (m, 2): a pinhole camera."""
    back = (place - target) / np.linalg.norm(place - target)
    right = np.cross([0.0, 1.0, 0.0], back)
    right /= np.linalg.norm(right)
    axes = np.stack([right, np.cross(back, right)], axis=1)
    up = np.tan(window.field_of_view / 2)
    away = points - place
    return (away @ axes) / -(away @ back)[:, None] / [up * window.aspect, up]


@pytest.mark.rotating(2)
@pytest.mark.parametrize("window", WINDOWS, ids=str)
@pytest.mark.parametrize("scene", names())
def test_all_is_in_the_picture_and_fills_it(scene: str, window: Window) -> None:
    """Also what is before the panel of a narrow screen is not. Shown to fail: half as far away, it is not in it."""
    system = open_scene(scene).system
    place, target = camera(system, np.zeros((1, 3)), window)
    corners = np.array(list(product(*zip(*box(system), strict=True))))
    shown = seen(corners, place, target, window)
    # above what is covered: from 2 covered - 1 to 1
    shown[:, 1] = (shown[:, 1] - window.covered) / (1 - window.covered)
    most = np.abs(shown).max()
    assert most <= FILLED + 1e-9
    assert most >= 0.8 * FILLED
    near = target + (place - target) / 2
    assert np.abs(seen(corners, near, target, window)).max() > FILLED or window.covered
    np.testing.assert_allclose(np.cross(place - target, TOWARDS[system.dimension]), 0, atol=1e-12 * system.size)


def test_a_string_may_swing_to_its_other_side() -> None:
    """It hangs by one mass, at x = 0; a bridge has no other side."""
    low, high = box(open_scene("string").system)
    np.testing.assert_allclose([low[0], high[0], low[1]], np.array([-1.1, 1.1, -0.9]) * 1.25)
    low, high = box(open_scene("bridge").system)
    assert low[0] > -3


def test_lanes_side_by_side_do_not_overlap_and_use_the_window() -> None:
    """Four strings, wider than high: one below the other in a tall window, beside each other in a very wide one."""
    system = open_scene("string").system
    size = np.subtract(*box(system)[::-1])[:2]
    for aspect, columns in ((0.5, 1), (2.0, 2), (9.0, 4)):
        shifts = side_by_side(system, 4, Window(1.3, aspect))
        assert len(np.unique(shifts[:, 0])) == columns
        for i, j in product(range(4), range(4)):
            assert i == j or (np.abs(shifts[i, :2] - shifts[j, :2]) >= size - 1e-9).any()


def row(*places: tuple[float, float], fixed: tuple[int, ...] = (), obstacles: tuple[Obstacle, ...] = ()) -> Array:
    """The box of masses at these places [m], shape (2, 3)."""
    system = MassSpringSystem(
        positions=np.array(places),
        springs=np.column_stack([np.arange(len(places) - 1), np.arange(1, len(places))]),
        masses=np.array(1.0),
        rest_lengths=np.array(1.0),
        stiffness=np.array(1.0),
        fixed=np.isin(np.arange(len(places)), fixed),
        obstacles=obstacles,
    )
    return np.stack(box(system)) + 0.1 * system.size * np.array([[1.0], [-1.0]])


def test_what_is_flat_and_held_will_hang() -> None:
    """Less high than a tenth of its size: 0.8 of that below; held by one mass it swings to the other side of that."""
    flat = (1.0, 2.0), (2.0, 2.1), (3.0, 2.0)
    low, high = 2.0 - 0.8 * 2.0, 2.1
    assert row(*flat) == pytest.approx(np.array([[1, 2, 0], [3, 2.1, 0]]))
    assert row(*flat, fixed=(0, 2)) == pytest.approx(np.array([[1, low, 0], [3, high, 0]]))
    assert row(*flat, fixed=(0,)) == pytest.approx(np.array([[-1, low, 0], [3, high, 0]]))
    assert row(*flat, fixed=(1,)) == pytest.approx(np.array([[1, low, 0], [3, high, 0]]))
    assert row(*flat, fixed=(2,)) == pytest.approx(np.array([[1, low, 0], [5, high, 0]]))
    steep = ((1.0, 2.0), (2.0, 2.3), (3.0, 2.0))
    assert row(*steep, fixed=(0,)) == pytest.approx(np.array([[1, 2, 0], [3, 2.3, 0]]))


def test_round_obstacles_no_larger_than_the_system_are_in_the_picture() -> None:
    """Larger ones are not, nor planes."""
    steep = ((1.0, 2.0), (2.0, 5.0), (4.0, 2.0))
    alone = np.array([[1, 2, 0], [4, 5, 0]])
    assert row(*steep, obstacles=(Plane((0.0, -9.0), (0.0, 1.0)), Circle((2.0, 12.0), 5.0))) == pytest.approx(alone)
    low_left, up_right = Circle((-1.0, 0.0), 2.0), Circle((6.0, 7.0), 3.0)
    assert row(*steep, obstacles=(low_left,)) == pytest.approx(np.array([[-3, -2, -2], [4, 5, 2]]))
    assert row(*steep, obstacles=(low_left, up_right)) == pytest.approx(np.array([[-3, -2, -3], [9, 10, 3]]))


@pytest.mark.parametrize("window", WINDOWS, ids=str)
def test_lanes_that_are_apart_are_all_in_the_picture(window: Window) -> None:
    """Across, and one above the other: the farthest corner of all is at the border of what is filled."""
    system = open_scene("string").system
    low, high = box(system)
    for shifts in (np.array([[0.0, 0.0, 0.0], [3.0, -5.0, 0.0]]), np.array([[-4.0, 1.0, 0.0], [0.5, 2.0, 0.0]])):
        place, target = camera(system, shifts, window)
        corners = np.array(list(product(*zip(low + shifts.min(axis=0), high + shifts.max(axis=0), strict=True))))
        shown = seen(corners, place, target, window)
        shown[:, 1] = (shown[:, 1] - window.covered) / (1 - window.covered)
        assert np.abs(shown).max() == pytest.approx(FILLED)
