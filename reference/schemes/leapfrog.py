"""Leapfrog in its forms, its compositions, and symplectic Euler with drag in its forms (`catalogue.wide_schemes`).

Their orders are those without damping and drag: forces that depend on velocities are taken at velocities that are at
hand, which costs orders. HLW is Hairer, Lubich and Wanner, *Geometric Numerical Integration* (2006).
"""

from __future__ import annotations

import numpy as np

from reference.motion import Motion, MotionOfSprings
from reference.schemes.catalogue import scheme
from reference.state import State

#: The outer and inner step of the fourth-order composition, as parts of dt.
OUTER = 1 / (2 - 2 ** (1 / 3))
INNER = 1 - 2 * OUTER


@scheme(order=2, kind="wide_scheme")
def leapfrog_kick_drift_kick(motion: Motion, state: State, dt: float) -> State:
    """Leapfrog: half a kick, a drift, half a kick at the half-way velocity (HLW I.1.4)."""
    halfway = state.kick(dt / 2 * motion.acceleration(state)).drift(dt)
    return halfway.kick(dt / 2 * motion.acceleration(halfway))


@scheme(order=2, kind="wide_scheme")
def leapfrog_drift_kick_drift(motion: Motion, state: State, dt: float) -> State:
    """Leapfrog, positions first: half a drift, a kick, half a drift (HLW I.1.4)."""
    halfway = state.drift(dt / 2)
    return halfway.kick(dt * motion.acceleration(halfway)).drift(dt / 2)


@scheme(order=2, kind="wide_scheme", one_step=False)
def stormer_verlet(motion: Motion, state: State, dt: float) -> State:
    """Verlet by positions: x + (x - x before) + dt^2 a, velocities (x after - x before) / 2 dt (Verlet 1967).

    That velocity is known a step late: here it is the last difference and half a kick.
    """
    acceleration = motion.acceleration(state)
    if state.memory:
        (before,) = state.memory
        moved = state.positions + (state.positions - before) + dt**2 * acceleration
    else:
        moved = state.positions + dt * state.velocities + dt**2 / 2 * acceleration
    velocities = (moved - state.positions) / dt
    there = motion.acceleration(State(state.time + dt, moved, velocities))
    return State(state.time + dt, moved, velocities + dt / 2 * there).remembering(state.positions)


@scheme(order=2, kind="wide_scheme", one_step=False)
def beeman(motion: Motion, state: State, dt: float) -> State:
    """Beeman: the positions of Verlet with more accurate velocities (Beeman, J. Comput. Phys. 20, 1976)."""
    here = motion.acceleration(state)
    before = state.memory[0] if state.memory else here
    x = state.positions + dt * state.velocities + dt**2 / 6 * (4 * here - before)
    guess = state.velocities + dt / 2 * (3 * here - before)
    there = motion.acceleration(State(state.time + dt, x, guess))
    v = state.velocities + dt / 6 * (2 * there + 5 * here - before)
    return State(state.time + dt, x, v).remembering(here)


@scheme(order=4, kind="wide_scheme")
def forest_ruth(motion: Motion, state: State, dt: float) -> State:
    """Three leapfrogs, positions first, the middle one backwards: order four (Forest and Ruth, Physica D 43, 1990)."""
    for part in (OUTER, INNER, OUTER):
        halfway = state.drift(part * dt / 2)
        state = halfway.kick(part * dt * motion.acceleration(halfway)).drift(part * dt / 2)
    return state


@scheme(order=4, kind="wide_scheme")
def yoshida_4(motion: Motion, state: State, dt: float) -> State:
    """Three leapfrogs, velocities first, the middle one backwards: order four (Yoshida, Phys. Lett. A 150, 1990)."""
    for part in (OUTER, INNER, OUTER):
        halfway = state.kick(part * dt / 2 * motion.acceleration(state)).drift(part * dt)
        state = halfway.kick(part * dt / 2 * motion.acceleration(halfway))
    return state


@scheme(order=1, kind="wide_scheme", linear=False)
def kick_drift_drag_afterwards(motion: MotionOfSprings, state: State, dt: float) -> State:
    """Kick-drift, its new velocities then slowed by 1 - dt Cd/m: how games write drag."""
    rate = motion.system.drag / motion.system.masses[:, None]
    kicked = state.kick(dt * (motion.acceleration(state) + rate * state.velocities))
    return kicked.kick(-dt * rate * kicked.velocities).drift(dt)


@scheme(order=1, kind="wide_scheme", linear=False)
def kick_drift_exponential_drag(motion: MotionOfSprings, state: State, dt: float) -> State:
    """Kick-drift, its new velocities then slowed by exp(-dt Cd/m), which is exact for drag alone (HLW II.5)."""
    rate = motion.system.drag / motion.system.masses[:, None]
    kicked = state.kick(dt * (motion.acceleration(state) + rate * state.velocities))
    return kicked.kick(np.expm1(-dt * rate) * kicked.velocities).drift(dt)
