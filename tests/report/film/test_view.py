"""Where one looks from, and how much of it a window shows: by hand, on what is not symmetric."""

from __future__ import annotations

import math

import numpy as np
import pytest

from report.film.view import View, Window, box_of, outside, view_of, window_around

#: Corners of what is 2 m wide, 4 m high and 4 m deep: 6 m from corner to corner.
CORNERS = np.array([[1.0, -1.0, 0.0], [3.0, 3.0, 4.0], [2.0, 0.0, 1.0]])


def test_space_is_looked_at_from_the_right_and_above_and_from_far_enough() -> None:
    """At the middle of what there is; less steeply from above than from the side; up stays up, the horizon level."""
    view = view_of(CORNERS)
    right, up, towards = view.axes
    assert view.middle == pytest.approx([2, 1, 2])
    assert 2 * 6 <= view.distance <= 5 * 6
    sideways, upwards = math.degrees(math.atan2(towards[0], towards[2])), math.degrees(math.asin(towards[1]))
    assert 0 < upwards < sideways < 45
    assert right[1] == 0
    assert min(right[0], up[1], towards[2]) > 0.7
    assert np.cross(right, up) == pytest.approx(towards)
    assert np.isfinite(view.project(CORNERS)[0]).all()


def test_the_plane_is_seen_as_it_is() -> None:
    """Places are their own pictures, wherever the middle is, and none is nearer than another; so for a whole motion."""
    motion = np.array([[[1.0, 2.0], [3.0, 5.0]], [[-1.0, 7.0], [3.0, 4.0]]])
    for view in (view_of(motion), View(np.array([3.0, -1.0]), np.eye(2), np.inf)):
        places, nearer = view.project(motion)
        assert places.tolist() == motion.tolist()
        assert nearer.tolist() == [[0, 0], [0, 0]]
    assert view_of(motion).distance == np.inf


def test_what_is_as_near_as_the_eye_has_no_place() -> None:
    """Nor what is behind it; only a little before it still has."""
    view = View(np.zeros(3), np.eye(3), 4.0)
    places, _ = view.project(np.array([[0.1, 0.2, 3.99], [0.1, 0.2, 4.0], [0.1, 0.2, 4.01]]))
    assert places[0] == pytest.approx([40, 80])
    assert np.isnan(places[1:]).all()


def test_a_ray_through_a_place_goes_through_all_that_is_seen_there() -> None:
    """From the eye, at any distance along it; of length 1."""
    view = view_of(CORNERS)
    places = np.array([[[0.3, -0.2], [1.0, 0.5]]])
    eye, rays = view.rays(places)
    assert eye == pytest.approx(view.middle + view.distance * view.axes[2])
    assert np.linalg.norm(rays, axis=-1) == pytest.approx(np.ones((1, 2)))
    for far in (1.0, view.distance, 3 * view.distance):
        assert view.project(eye + far * rays)[0] == pytest.approx(places)


@pytest.mark.parametrize(
    ("boxes", "wanted"),
    [
        pytest.param([(0, 2, 0, 1)], (-0.12, 2.12, -0.13, 1.06), id="6 % of room, 13 % below"),
        pytest.param([(5, 5, 1, 3)], (5 - 0.45, 5 + 0.45, 0.74, 3.12), id="no narrower than 45 % of what is high"),
        pytest.param([(0, 1, 2, 2)], (-0.06, 1.06, 2 - 0.252, 2 + 0.252), id="nor flatter than 45 % of what is wide"),
        pytest.param([(0, 2, 0, 2), (0.1, 1, 0.5, 2)], (-0.12, 2.12, -0.26, 2.12), id="what is within changes nothing"),
        pytest.param(
            [(0, 2, 0, 2), (-0.5, 9, -9, 2.25), (0.5, 1.5, -0.1, 2)],
            (-0.5 - 0.06 * 3.1, 2.6 + 0.06 * 3.1, -0.6 - 0.13 * 2.85, 2.25 + 0.06 * 2.85),
            id="others as far as they go, up to 30 % of the first",
        ),
    ],
)
def test_a_window_has_room_about_what_moves(boxes: list[Window], wanted: Window) -> None:
    """Left, right, bottom, top."""
    assert window_around(boxes) == pytest.approx(wanted)


def test_a_window_goes_with_what_it_shows() -> None:
    """Elsewhere it is elsewhere, and of what is larger it is larger, whichever box reaches out of which."""
    boxes = np.array([(1.0, 4.0, -2.0, 3.0), (0.8, 9.0, -2.5, 2.0), (2.0, 3.0, -9.0, 4.0)])
    found = np.array(window_around([tuple(box) for box in boxes]))
    shift = np.array([5.0, 5.0, -7.0, -7.0])
    assert window_around([tuple(box) for box in boxes + shift]) == pytest.approx(found + shift)
    assert window_around([tuple(box) for box in 3 * boxes]) == pytest.approx(3 * found)


def test_how_much_others_may_add_is_a_part_of_the_first() -> None:
    """Half of it, where that is asked for."""
    one, other = (0.0, 2.0, 0.0, 2.0), (-9.0, 2.0, 0.0, 9.0)
    left, _, _, top = window_around([one, other], most=0.5)
    assert (left, top) == pytest.approx((-1 - 0.06 * 3, 3 + 0.06 * 3))


def test_a_box_is_of_what_is_finite_and_what_is_not_is_outside() -> None:
    """A place on the border is inside; one a little beyond any of four sides is not."""
    places = np.array([[[1.0, 5.0], [np.nan, 7.0]], [[3.0, np.inf], [2.0, 6.0]]])
    assert box_of(places) == (1, 3, 5, 7)
    window = (1.0, 3.0, 5.0, 7.0)
    inside = np.array([[1.0, 5.0], [3.0, 7.0], [2.0, 6.0]])
    beyond = np.array([[0.9, 6.0], [3.1, 6.0], [2.0, 4.9], [2.0, 7.1], [np.nan, 6.0], [2.0, np.nan], [np.inf, 6.0]])
    assert not outside(inside, window).any()
    assert outside(beyond, window).all()
