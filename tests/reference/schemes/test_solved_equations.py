"""Schemes that solve by Newton's method: their equations hold on springs that turn, at any speed, where it is stiff."""

from __future__ import annotations

import numpy as np
import pytest

from reference.forces import SpringMotion
from reference.schemes.catalogue import find
from reference.state import Array, State
from reference.system import MassSpringSystem
from tests.reference.systems import moving_string

#: By Newton's method, each in its own loop or by one of those.
BY_NEWTON = ["backward_euler", "implicit_midpoint", "bdf2", "newmark", "hht", "generalised_alpha", "radau_iia"]


# --- Springs that turn ---

#: Of generalised alpha: m, f, beta, gamma (Chung and Hulbert 1993; Newmark's has m = f = 0, HHT's m = 0, f = -alpha).
CONSTANTS = {
    "newmark(beta=0.3, gamma=0.6)": (0.0, 0.0, 0.3, 0.6),
    "hht(alpha=-0.25)": (0.0, 0.25, 1.25**2 / 4, 0.75),
    "generalised_alpha(radius=0.25)": (-0.4, 0.2, 1.6**2 / 4, 1.1),
}


@pytest.mark.parametrize("name", CONSTANTS)
def test_schemes_of_structures_solve_their_equations_on_springs_that_turn(name: str) -> None:
    """(1 - m) a1 + m a0 = the acceleration at (1 - f) of the end and f of the start, to 1e-9 of 10 m/s^2 over 4 steps.

    HHT weighs accelerations in place of states. At this step one round of Newton's method is not enough.
    """
    m, f, beta, gamma = CONSTANTS[name]
    motion, h = SpringMotion(moving_string(4, damping=0.05, drag=0.02)), 0.01
    advance, state = find(name).on(motion), motion.start
    before = motion.acceleration(state)
    for _ in range(4):
        end = advance(state, h)
        after = end.memory[0] if end.memory else motion.acceleration(end)
        x = state.positions + h * state.velocities + h**2 * ((0.5 - beta) * before + beta * after)
        v = state.velocities + h * ((1 - gamma) * before + gamma * after)
        if name.startswith("hht"):
            force = (1 - f) * motion.acceleration(end) + f * motion.acceleration(state)
        else:
            between = [(1 - f) * b + f * a for a, b in zip(numbers(state), numbers(end), strict=True)]
            force = motion.acceleration(State(state.time + (1 - f) * h, *between))
        assert np.abs(end.positions - x).max() < 1e-13
        assert np.abs(end.velocities - v).max() < 1e-12
        assert np.abs((1 - m) * after + m * before - force).max() < 1e-9
        state, before = end, after if end.memory else motion.acceleration(end)


def numbers(state: State) -> tuple[Array, Array]:
    """Its positions and velocities."""
    return state.positions, state.velocities


# --- At any speed ---


def flying(speed: float) -> MassSpringSystem:
    """Two masses on a damped spring that is stretched, flying along the first axis; and a third one, fixed, apart."""
    thrown = np.array([[0.0, 0.0], [speed, 0.0], [speed, 0.3]])
    return MassSpringSystem(
        positions=np.array([[0.0, -9.0], [0.0, 0.0], [0.6, 0.8]]),
        springs=np.array([[1, 2]]),
        masses=np.array([1.0, 0.3, 0.2]),
        rest_lengths=np.array(0.9),
        stiffness=np.array(1e3),
        damping=np.array(0.7),
        gravity=np.zeros(2),
        velocities=thrown,
        fixed=np.array([True, False, False]),
    )


@pytest.mark.parametrize("name", BY_NEWTON)
def test_what_flies_fast_is_stepped_as_what_does_not(name: str) -> None:
    """At 1e8 m/s rounding is 1.5e-8 m/s: that is as near as a solution comes, and near enough, beside a mass at rest.

    By Galileo it swings as without: within 1e-6 m/s after three steps.
    """
    dt, ends = 1e-3, []
    for speed in (0.0, 1e8):
        system = flying(speed)
        advance, state = find(name).on(SpringMotion(system)), system.start
        for _ in range(3):
            state = advance(state, dt)
        ends.append((state.positions[1:] - [3 * dt * speed, 0.0], state.velocities[1:] - [speed, 0.0]))
    np.testing.assert_allclose(ends[1][0], ends[0][0], atol=1e-8)
    np.testing.assert_allclose(ends[1][1], ends[0][1], atol=1e-6)
    assert np.abs(ends[0][1]).max() > 0.5


# --- Where it is stiff ---


def test_radau_damps_at_once_what_is_fast() -> None:
    """Of z = h A its step is (I - 2 z/3 + z^2/6)^-1 (I + z/3), the Pade approximation of exp (HW IV.5).

    A mass with h c/m = 300 and h^2 k/m = 1e4: a stage that took another's place would not be solved for.
    """
    h, square, rate = 0.1, 1e6, 3e3
    system = MassSpringSystem(
        positions=np.array([[0.0], [3.0]]),
        springs=np.array([[0, 1]]),
        masses=np.array(2.0),
        rest_lengths=np.array(3.0),
        stiffness=np.array(2 * square),
        damping=np.array(2 * rate),
        gravity=np.zeros(1),
        fixed=np.array([True, False]),
    )
    begun = np.array([3e-5, -1.2e-4])  # so that on the way to a solution, too, the spring has a length
    state = State(0.0, system.positions + np.array([[0.0], begun[:1]]), np.array([[0.0], begun[1:]]))
    end = find("radau_iia").on(SpringMotion(system))(state, h)
    z = h * np.array([[0.0, 1.0], [-square, -rate]])
    expected = np.linalg.solve(np.eye(2) - 2 * z / 3 + z @ z / 6, (np.eye(2) + z / 3) @ begun)
    np.testing.assert_allclose([end.positions[1, 0] - 3, end.velocities[1, 0]], expected, rtol=1e-6, atol=1e-12)
