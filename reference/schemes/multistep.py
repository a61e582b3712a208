"""Multistep methods that people write (`catalogue.wide_schemes`).

HNW is Hairer, Norsett and Wanner, *Solving Ordinary Differential Equations I* (1993).
"""

from __future__ import annotations

import numpy as np

from reference.assembly import solve_velocities
from reference.errors import SolverError
from reference.motion import Motion, MotionOfSprings
from reference.schemes.catalogue import scheme
from reference.schemes.textbook import backward_euler
from reference.state import Slope, State


@scheme(order=2, kind="wide_scheme", one_step=False)
def adams_bashforth_2(motion: Motion, state: State, dt: float) -> State:
    """Adams-Bashforth of two steps, begun with Heun: 3/2 of the slope here less 1/2 of the one before (HNW III.1)."""
    here = motion.slope(state)
    if state.memory:
        before = Slope(1.0, *state.memory)
        end = state + dt / 2 * (3 * here + -1 * before)
    else:
        end = state + dt / 2 * (here + motion.slope(state + dt * here))
    return end.remembering(here.positions, here.velocities)


@scheme(order=2, kind="wide_scheme", implicit=True, one_step=False)
def bdf2(motion: MotionOfSprings, state: State, dt: float) -> State:
    """Backward differentiation of two steps, begun with backward Euler: 3/2 y1 - 2 y0 + y-1/2 = dt f(y1) (HNW III.1).

    Raises:
        SolverError: if Newton's method finds no solution at this dt.
    """
    if not state.memory:
        return backward_euler(motion, state, dt).remembering(state.positions, state.velocities)
    x = (4 * state.positions - state.memory[0]) / 3
    v = (4 * state.velocities - state.memory[1]) / 3
    part = 2 * dt / 3
    end = State(state.time + dt, x + part * state.velocities, state.velocities)
    for _ in range(50):
        by_position, by_velocity = motion.jacobians(end)
        missing = v + part * motion.acceleration(end) - end.velocities
        change = solve_velocities(motion.system, part * by_velocity + part**2 * by_position, missing)
        velocities = end.velocities + change
        end = State(end.time, x + part * velocities, velocities)
        if np.abs(change).max() <= 1e-9 * np.abs(velocities).max() + 1e-13 * motion.system.size / abs(dt):
            return end.remembering(state.positions, state.velocities)
    raise SolverError(f"BDF2 found no solution at t = {state.time:.6g} s with dt = {dt:g} s")
