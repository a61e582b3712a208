"""What schemes make of springs and drags in a step, against their definitions; and which steps are quadratics."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from reference.scenes import find as find_scene
from reference.schemes.catalogue import find
from reference.state import Array
from reference.theory.linearisation import Linearisation
from reference.theory.step_coefficients import (
    coefficients,
    damping_in_step,
    is_quadratic,
    odd_system,
    solves_for_positions,
)

#: Of a mass m, with the damping h c = e in a step of h: q and e of A2 = m + q + kappa h^2 k, A0 = A2 - e - eps h^2 k.
#: Backward Euler (m + h c + h^2 k) v' = m v - h k x; the midpoint has half of c and a quarter of k on either side.
MADE: dict[str, tuple[Callable[[Array, Array], Array], Callable[[Array, Array], Array], float, float]] = {
    "kick_drift": (lambda m, e: 0 * m, lambda m, e: e, 0.0, 0.0),
    "drift_kick": (lambda m, e: 0 * m, lambda m, e: e, 0.0, 0.0),
    "backward_euler": (lambda m, e: e, lambda m, e: e, 1.0, 1.0),
    "implicit_midpoint": (lambda m, e: e / 2, lambda m, e: e, 0.25, 0.0),
    "kick_drift_implicit_damping": (lambda m, e: e, lambda m, e: e, 0.0, 0.0),
    "drift_kick_exponential_damping": (
        lambda m, e: m * np.expm1(e / m),
        lambda m, e: m * np.expm1(e / m),
        0.0,
        0.0,
    ),
}


@pytest.mark.parametrize("name", MADE)
def test_what_a_step_makes_of_three_springs(name: str) -> None:
    """All of them unequal; in a step of 0.3 s, to rounding."""
    m, c, h = np.array([0.5, 2.0, 3.0]), np.array([0.1, 1.7, 4.0]), 0.3
    implicit, everything, kappa, epsilon = MADE[name]
    found = coefficients(find(name), h, m, c)
    assert found.implicit == pytest.approx(implicit(m, h * c), abs=1e-9)
    assert found.all == pytest.approx(everything(m, h * c), abs=1e-9)
    assert found.implicit_stiffness == pytest.approx(kappa, abs=1e-9)
    assert found.damping_stiffness == pytest.approx(epsilon, abs=1e-9)
    some = found.of(np.array([2, 0, 2]))
    assert some.all.tolist() == found.all[[2, 0, 2]].tolist()
    assert some.implicit.tolist() == found.implicit[[2, 0, 2]].tolist()


def test_springs_and_masses_of_a_system_are_each_looked_at_alone() -> None:
    """By the effective mass of a spring's two ends, its damping, and the drag of a mass; in their order."""
    system = find_scene("string").system(
        {"masses": 3, "mass": [0.2, 0.1, 0.4], "damping": [0.5, 0.3, 0.1], "drag": 0.06, "angle": 90.0}
    )
    made = damping_in_step(find("backward_euler"), Linearisation(system, system.start), 0.1)
    assert made.springs.all == pytest.approx([0.05, 0.03, 0.01], abs=1e-12)
    assert made.drag.all == pytest.approx([0.006] * 4, abs=1e-12)
    exponential = damping_in_step(find("drift_kick_exponential_damping"), Linearisation(system, system.start), 0.1)
    effective = np.array([0.2, 1 / (1 / 0.2 + 1 / 0.1), 1 / (1 / 0.1 + 1 / 0.4)])
    assert exponential.springs.all == pytest.approx(effective * np.expm1([0.05, 0.03, 0.01] / effective), rel=1e-9)
    undragged = damping_in_step(
        find("backward_euler"), Linearisation(system.with_parameter("drag", 0.0), system.start), 0.1
    )
    assert undragged.drag.all.tolist() == [0.0] * 4


@pytest.mark.parametrize(
    ("name", "quadratic", "positions"),
    [
        ("kick_drift", True, False),
        ("backward_euler", True, True),
        ("implicit_midpoint", True, True),
        ("kick_drift_implicit_damping", True, False),
        ("drift_kick_exponential_damping", True, False),
        ("velocity_verlet", True, False),
        ("heun", False, False),
        ("rk4", False, False),
        ("euler_in_place", False, False),
        ("adams_bashforth_2", False, False),
        ("bdf2", False, True),
        ("radau_iia", False, True),
    ],
)
def test_which_steps_are_quadratics_and_which_solve_for_positions(name: str, quadratic: bool, positions: bool) -> None:
    """One step, with positions and velocities taken one after the other, or together by one equation."""
    assert is_quadratic(find(name), False, False) == quadratic
    assert solves_for_positions(find(name)) == positions


@pytest.mark.parametrize(
    ("name", "damped", "dragged"), [("kick_drift", True, True), ("kick_drift_truncated_damping", False, True)]
)
def test_what_stops_iterating_is_a_quadratic_without_damping_only(name: str, damped: bool, dragged: bool) -> None:
    """Without it there is nothing to iterate for."""
    assert is_quadratic(find(name), damped, dragged)
    assert not is_quadratic(find("kick_drift_truncated_damping"), True, dragged)


def test_the_system_that_is_tried_has_damping_and_drag_where_they_are_asked_for() -> None:
    """Each alone, both or none."""
    for damped in (False, True):
        for dragged in (False, True):
            system = odd_system(damped, dragged)
            assert system.damping.all() == system.damping.any() == damped
            assert (system.drag > 0) == dragged
