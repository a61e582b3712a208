"""The circle of slides 16-17: the lab's rule, slide 17's as it is meant, and as it is printed."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reference.errors import InputError
from reference.lecture.slide_17 import CircleAsMeant, CircleAsPrinted
from reference.obstacles import Circle, Plane
from reference.obstacles.validation import ROUNDING, checked_obstacles
from reference.state import Array
from tests.reference.systems import property_test

CIRCLE = Circle((0.3, -0.2), 0.5)
AS_MEANT, AS_PRINTED = CircleAsMeant(CIRCLE.centre, CIRCLE.radius), CircleAsPrinted(CIRCLE.centre, CIRCLE.radius)

#: What becomes of positions and velocities, each (n, 2).
Rule = Callable[[Array, Array], tuple[Array, Array]]

angles = st.floats(0.0, 2 * np.pi)


def check_projection(rule: Rule, angle: float, depth: float, velocity: Array, holds: bool = False) -> None:
    """A mass inside comes to the circle straight out, and keeps v_t = (v . t) t with t along the circle, to rounding.

    So the velocity along the circle is what it was; that across it is what leads outwards of what it was, max(v.n, 0),
    or, by a rule that `holds` masses, zero.
    """
    out, along = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
    inside = np.array(CIRCLE.centre) + (CIRCLE.radius - depth) * out
    x, v = rule(inside[None], velocity[None])
    assert x[0] == pytest.approx(np.array(CIRCLE.centre) + CIRCLE.radius * out, abs=1e-15)
    scale = np.abs(velocity).max() + 1e-300
    # The direction is that of a difference of coordinates up to 0.8 m: near the centre it rounds by 1e-16 m over 0.1 m.
    assert v[0] @ along == pytest.approx(velocity @ along, abs=1e-14 * scale)
    outwards = 0.0 if holds else max(velocity @ out, 0.0)
    assert v[0] @ out == pytest.approx(outwards, abs=1e-14 * scale)


@property_test
@given(angle=angles, depth=st.floats(1e-6, 0.4), vx=st.floats(-5, 5), vy=st.floats(-5, 5))
def test_the_tangential_velocity_is_kept_anywhere_on_the_circle(
    angle: float, depth: float, vx: float, vy: float
) -> None:
    """Whatever the velocity, by the lab's rule and by slide 17's as it is meant."""
    check_projection(CIRCLE.projected, angle, depth, np.array([vx, vy]))
    check_projection(AS_MEANT.projected, angle, depth, np.array([vx, vy]), holds=True)


def reflect(positions: Array, velocities: Array) -> tuple[Array, Array]:
    """Bounces in place of sliding."""
    x, kept = AS_MEANT.projected(positions, velocities)
    return x, 2 * kept - velocities


def turned(positions: Array, velocities: Array) -> tuple[Array, Array]:
    """Keeps what is across and drops what is along."""
    x, kept = AS_MEANT.projected(positions, velocities)
    return x, velocities - kept


@pytest.mark.parametrize("rule", [AS_PRINTED.projected, reflect, turned])
@pytest.mark.parametrize("angle", [0.0, 0.7, 2.0, 3.0])
def test_projection_fails_on_other_rules(rule: Rule, angle: float) -> None:
    """The printed rule among them, which is right at the top of the circle only."""
    inwards = -np.array([np.cos(angle), np.sin(angle)]) + 0.3 * np.array([-np.sin(angle), np.cos(angle)])
    with pytest.raises(AssertionError):
        check_projection(rule, angle, 0.1, inwards)
    with pytest.raises(AssertionError):
        check_projection(rule, angle, 0.1, inwards, holds=True)


def test_the_two_rules_differ_where_a_mass_moves_outwards() -> None:
    """Each fails the other's check there."""
    outwards = np.array([1.0, 0.5])
    with pytest.raises(AssertionError):
        check_projection(AS_MEANT.projected, 0.0, 0.1, outwards)
    with pytest.raises(AssertionError):
        check_projection(CIRCLE.projected, 0.0, 0.1, outwards, holds=True)


@pytest.mark.parametrize(
    ("angle", "left"), [(0.0, -1.0), (np.pi / 2, 1.0), (np.pi, 1.0), (3 * np.pi / 2, -1.0), (np.pi / 4, 0.0)]
)
def test_the_printed_rule_by_hand(angle: float, left: float) -> None:
    """A mass sliding along at 1 m/s: (v_x n_y, -v_y n_x) with v = (-sin, cos), n = (cos, sin) is (-sin^2, -cos^2).

    Along the circle that is sin^3 - cos^3.
    """
    along = np.array([-np.sin(angle), np.cos(angle)])
    inside = np.array(CIRCLE.centre) + 0.4 * np.array([np.cos(angle), np.sin(angle)])
    _, v = AS_PRINTED.projected(inside[None], along[None])
    assert v[0] == pytest.approx([-(np.sin(angle) ** 2), -(np.cos(angle) ** 2)], abs=1e-15)
    assert v[0] @ along == pytest.approx(np.sin(angle) ** 3 - np.cos(angle) ** 3, abs=1e-15)
    assert v[0] @ along == pytest.approx(left, abs=1e-14)


@pytest.mark.parametrize("rule", [CIRCLE.projected, AS_MEANT.projected, AS_PRINTED.projected])
def test_masses_outside_are_left_alone(rule: Rule) -> None:
    """To the bit; and each mass is judged alone."""
    positions = np.array([[0.3, 0.3], [0.3, 0.1], [5.0, 5.0]])
    velocities = np.array([[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]])
    x, v = rule(positions, velocities)
    assert x[[0, 2]].tolist() == positions[[0, 2]].tolist()
    assert v[[0, 2]].tolist() == velocities[[0, 2]].tolist()
    assert x[1].tolist() != positions[1].tolist()


def test_a_mass_on_the_circle_after_being_pushed_out_stays() -> None:
    """Pushing out twice changes nothing more than a rounding."""
    x, v = CIRCLE.projected(np.array([[0.35, 0.1]]), np.array([[1.0, -2.0]]))
    again_x, again_v = CIRCLE.projected(x, v)
    assert again_x == pytest.approx(x, abs=1e-15)
    assert again_v == pytest.approx(v, abs=1e-15)


def test_a_mass_at_the_very_centre_gives_numbers() -> None:
    """There is no way straight out: nothing that is not a number comes of it."""
    x, v = CIRCLE.projected(np.array([[0.3, -0.2]]), np.array([[1.0, -2.0]]))
    assert np.isfinite(x).all()
    assert np.isfinite(v).all()


@pytest.mark.parametrize("size", [1.0, 40.0])
def test_a_start_inside_is_refused_but_for_rounding(size: float) -> None:
    """A billionth of the system's size [m] is rounding of a state that was projected out; twice as much is not.

    A fixed mass may be as deep as it likes.
    """
    assert ROUNDING == 1e-9
    floor, fixed = Plane((0.0, 0.0), (0.0, 1.0)), np.array([True, False])
    for depth in (0.5e-9, 2e-9):
        positions = np.array([[0.0, -1.0], [0.5, -depth * size]])
        if depth < ROUNDING:
            assert checked_obstacles([floor], positions, fixed, size) == (floor,)
        else:
            with pytest.raises(InputError, match=r"^positions\[1\] = .* inside$"):
                checked_obstacles([floor], positions, fixed, size)
