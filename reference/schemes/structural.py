"""Implicit schemes of structural dynamics, and Radau's (`catalogue.wide_schemes`).

HW is Hairer and Wanner, *Solving Ordinary Differential Equations II* (1996).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from reference.assembly import assemble, solve_velocities
from reference.errors import SolverError
from reference.motion import MotionOfSprings
from reference.schemes.catalogue import scheme
from reference.state import Array, State

#: Radau IIA of two stages: at 1/3 and 1, where the step ends.
RADAU = np.array([[5 / 12, -1 / 12], [3 / 4, 1 / 4]])


@scheme(order=2, kind="wide_scheme", implicit=True, ranges={"beta": (0, 1), "gamma": (0, 1.5)})
def newmark(motion: MotionOfSprings, state: State, dt: float, *, beta: float = 0.25, gamma: float = 0.5) -> State:
    """Newmark's method; 1/4 and 1/2 make it the trapezoidal rule (Newmark, J. Eng. Mech. Div. 85, 1959).

    Raises:
        SolverError: if Newton's method finds no solution at this dt.
    """
    here = motion.acceleration(state)
    return _solved(motion, state, dt, here, beta, gamma, lambda end, a: (end, motion.acceleration(end) - a, 1.0))[0]


@scheme(order=2, kind="wide_scheme", implicit=True, one_step=False, ranges={"alpha": (-1 / 3, 0)})
def hht(motion: MotionOfSprings, state: State, dt: float, *, alpha: float = -0.1) -> State:
    """Hilber, Hughes and Taylor's alpha method, which damps what is fast (Earthquake Eng. Struct. Dyn. 5, 1977).

    The acceleration at the end is (1 + alpha) times the one of the forces there, less alpha times that at the start.

    Raises:
        SolverError: if Newton's method finds no solution at this dt.
    """
    force = motion.acceleration(state)
    before = state.memory[0] if state.memory else force

    def missing(end: State, a: Array) -> tuple[State, Array, float]:
        return end, (1 + alpha) * motion.acceleration(end) - alpha * force - a, 1 + alpha

    beta, gamma = (1 - alpha) ** 2 / 4, 0.5 - alpha
    end, acceleration = _solved(motion, state, dt, before, beta, gamma, missing)
    return end.remembering(acceleration)


@scheme(order=2, kind="wide_scheme", implicit=True, one_step=False, ranges={"radius": (0, 1)})
def generalised_alpha(motion: MotionOfSprings, state: State, dt: float, *, radius: float = 0.8) -> State:
    """Chung and Hulbert's method, which damps what is fast by `radius` a step (J. Appl. Mech. 60, 1993).

    (1 - m) a1 + m a0 = the acceleration of the forces at (1 - f) of the end and f of the start.

    Raises:
        SolverError: if Newton's method finds no solution at this dt.
    """
    m, f = (2 * radius - 1) / (radius + 1), radius / (radius + 1)
    before = state.memory[0] if state.memory else motion.acceleration(state)

    def missing(end: State, a: Array) -> tuple[State, Array, float]:
        x = (1 - f) * end.positions + f * state.positions
        v = (1 - f) * end.velocities + f * state.velocities
        between = State(state.time + (1 - f) * dt, x, v)
        left = motion.acceleration(between) - m * before - (1 - m) * a
        return between, left / (1 - m), (1 - f) / (1 - m)

    beta, gamma = (1 - m + f) ** 2 / 4, 0.5 - m + f
    end, acceleration = _solved(motion, state, dt, before, beta, gamma, missing)
    return end.remembering(acceleration)


def _solved(
    motion: MotionOfSprings,
    state: State,
    dt: float,
    before: Array,
    beta: float,
    gamma: float,
    missing: Callable[[State, Array], tuple[State, Array, float]],
) -> tuple[State, Array]:
    """Newmark's end of a step, and the acceleration a there that leaves nothing missing, by Newton's method.

    Args:
        before: the acceleration at the start.
        missing: of an end and a: where forces are taken, what is missing of a, and how much more of it a force makes.
    """
    a = before
    for _ in range(50):
        x = state.positions + dt * state.velocities + dt**2 * ((0.5 - beta) * before + beta * a)
        v = state.velocities + dt * ((1 - gamma) * before + gamma * a)
        end = State(state.time + dt, x, v)
        where, left, part = missing(end, a)
        by_position, by_velocity = motion.jacobians(where)
        blocks = part * gamma * dt * by_velocity + part * beta * dt**2 * by_position
        change = solve_velocities(motion.system, blocks, left)
        a = a + change
        if dt * np.abs(change).max() <= 1e-12 * np.abs(v).max() + 1e-13 * motion.system.size / abs(dt):
            x = state.positions + dt * state.velocities + dt**2 * ((0.5 - beta) * before + beta * a)
            return State(end.time, x, state.velocities + dt * ((1 - gamma) * before + gamma * a)), a
    raise SolverError(f"Newton's method found no solution at t = {state.time:.6g} s with dt = {dt:g} s")


@scheme(order=3, kind="wide_scheme", implicit=True, interactive_up_to=100)
def radau_iia(motion: MotionOfSprings, state: State, dt: float) -> State:
    """Radau IIA of two stages: third order, and damps what is infinitely fast at once (Ehle 1969; HW IV.5).

    Raises:
        SolverError: if Newton's method finds no solution at this dt.
    """
    system = motion.system
    free = ~system.fixed
    if not free.any():
        return State(state.time + dt, state.positions, state.velocities)
    mass = np.repeat(system.masses[free], system.dimension)
    size, shape = len(mass), state.positions.shape
    stages = [motion.acceleration(state)] * 2
    for _ in range(50):
        velocities = [state.velocities + dt * (row[0] * stages[0] + row[1] * stages[1]) for row in RADAU]
        positions = [state.positions + dt * (row[0] * velocities[0] + row[1] * velocities[1]) for row in RADAU]
        points = [State(state.time, x, v) for x, v in zip(positions, velocities, strict=True)]
        left = [motion.acceleration(point) - a for point, a in zip(points, stages, strict=True)]
        matrix = np.zeros((2 * size, 2 * size))
        for i, point in enumerate(points):
            by_position, by_velocity = (assemble(system, blocks, sparse=False) for blocks in motion.jacobians(point))
            for j in range(2):
                here = dt * RADAU[i, j] * by_velocity + dt**2 * (RADAU @ RADAU)[i, j] * by_position
                matrix[i * size : (i + 1) * size, j * size : (j + 1) * size] = (i == j) * np.diag(mass) - here
        try:
            right = np.concatenate([mass[:, None] * r[free].reshape(size, -1) for r in left])
            change = np.linalg.solve(matrix, right).reshape(2, size, -1)
        except np.linalg.LinAlgError:
            break
        for i in range(2):
            moved = np.zeros(shape)
            moved[free] = change[i].reshape(moved[free].shape)
            stages[i] = stages[i] + moved
        if dt * np.abs(change).max() <= 1e-9 * np.abs(velocities[1]).max() + 1e-13 * system.size / abs(dt):
            v = [state.velocities + dt * (row[0] * stages[0] + row[1] * stages[1]) for row in RADAU]
            x = state.positions + dt * (RADAU[1, 0] * v[0] + RADAU[1, 1] * v[1])
            return State(state.time + dt, x, v[1])
    raise SolverError(f"Radau IIA found no solution at t = {state.time:.6g} s with dt = {dt:g} s")
