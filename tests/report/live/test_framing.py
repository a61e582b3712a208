"""Where the camera is: everything is in the picture, as large as it can be."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest

from reference.state import Array
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
