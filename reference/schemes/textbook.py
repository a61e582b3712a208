"""The schemes, as in the textbooks: each advances the whole state at once.

A scheme is given the equations of motion, a state and a step dt [s], and returns a new state. It never writes what it
reads, so it cannot be wrong in the way `in_place` is. Sources: HLW is Hairer, Lubich and Wanner, *Geometric Numerical
Integration* (2006); slides are the lecture's.
"""

from __future__ import annotations

import numpy as np

from reference.assembly import solve_velocities
from reference.errors import SolverError
from reference.motion import Motion, MotionOfSprings
from reference.schemes.catalogue import scheme
from reference.state import State


@scheme(order=1)
def euler(motion: Motion, state: State, dt: float) -> State:
    """Explicit Euler: go on along the slope here (Euler 1768; slide 15 shows it explode)."""
    return state + dt * motion.slope(state)


@scheme(order=2)
def heun(motion: Motion, state: State, dt: float) -> State:
    """Heun: the slope here, the slope at Euler's guess, and a step along their average (slides 6-7)."""
    here = motion.slope(state)
    there = motion.slope(state + dt * here)
    return state + dt / 2 * (here + there)


@scheme(order=1, aliases=("semi_implicit_euler", "symplectic_euler"))
def kick_drift(motion: Motion, state: State, dt: float) -> State:
    """Semi-implicit (symplectic) Euler, velocities first: positions move with the new velocities (HLW I.1.2)."""
    return state.kick(dt * motion.acceleration(state)).drift(dt)


@scheme(order=1, aliases=("semi_implicit_euler_positions_first", "symplectic_euler_positions_first"))
def drift_kick(motion: Motion, state: State, dt: float) -> State:
    """Semi-implicit (symplectic) Euler, positions first: forces where the masses have moved to (HLW I.1.2)."""
    drifted = state.drift(dt)
    return drifted.kick(dt * motion.acceleration(drifted))


@scheme(order=2)
def velocity_verlet(motion: Motion, state: State, dt: float) -> State:
    """Velocity Verlet: a parabola for the positions, the average acceleration for the velocities.

    Swope et al., J. Chem. Phys. 76 (1982). The acceleration at the end is taken at the velocity Euler would have there,
    which keeps it second order with damping (Groot and Warren, J. Chem. Phys. 107 (1997), with lambda = 1).
    """
    here = motion.acceleration(state)
    moved = state.kick(dt / 2 * here).drift(dt)
    there = motion.acceleration(moved.kick(dt / 2 * here))
    return moved.kick(dt / 2 * there)


@scheme(order=4)
def rk4(motion: Motion, state: State, dt: float) -> State:
    """The classic Runge-Kutta method: four slopes, weighted 1, 2, 2, 1 (Kutta 1901)."""
    first = motion.slope(state)
    second = motion.slope(state + dt / 2 * first)
    third = motion.slope(state + dt / 2 * second)
    fourth = motion.slope(state + dt * third)
    return state + dt / 6 * (first + 2 * second + 2 * third + fourth)


@scheme(order=1, implicit=True, interactive_up_to=2000)
def backward_euler(motion: MotionOfSprings, state: State, dt: float) -> State:
    """Implicit Euler: the slope at the end, wherever that is; Newton's method finds it.

    Hairer and Wanner, *Solving Ordinary Differential Equations II* (1996), IV.8. With x1 = x0 + dt v1, the unknown is
    v1 alone: m (v1 - v0) = dt f(x0 + dt v1, v1).

    Raises:
        SolverError: if Newton's method finds no solution at this dt.
    """
    end, rounding = state.drift(dt), 1e-13 * motion.system.size / abs(dt)
    for _ in range(50):
        by_position, by_velocity = motion.jacobians(end)
        missing = state.velocities + dt * motion.acceleration(end) - end.velocities
        change = solve_velocities(motion.system, dt * by_velocity + dt**2 * by_position, missing)
        velocities = end.velocities + change
        end = State(end.time, state.positions + dt * velocities, velocities)
        # Newton's error squares at each round: below 1e-9 of the velocities, the next change is rounding. Of a state
        # at rest the velocities themselves are rounding: there, masses moving by 1e-13 of the size are good enough.
        if np.abs(change).max() <= 1e-9 * np.abs(velocities).max() + rounding:
            return end
    raise SolverError(f"backward Euler found no solution at t = {state.time:.6g} s with dt = {dt:g} s")


@scheme(order=2, implicit=True, interactive_up_to=2000)
def implicit_midpoint(motion: MotionOfSprings, state: State, dt: float) -> State:
    """Implicit midpoint rule: the slope half-way, by half a step of backward Euler (HLW I.1.1).

    Raises:
        SolverError: if Newton's method finds no solution at this dt.
    """
    halfway = backward_euler(motion, state, dt / 2)
    return state + dt * motion.slope(halfway)
