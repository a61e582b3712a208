"""Steps that students write, right and wrong: the catalogue's schemes, and those that only students use.

A step here has the shape of the catalogue's (`reference.schemes`): equations of motion, state, dt -> state. All but one
thing of a wrong one is right. They stay out of the catalogue: no engine is looked for among them.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from experiments.exercises.solutions.links import LinkMotion
from reference.motion import Motion
from reference.schemes import catalogue
from reference.state import Array, State

Step = Callable[[Any, State, float], State]

#: A step [s] that the strings and springs of the exercises take well, and that is long enough to show what differs.
DT = 0.004

#: Units of positions and velocities.
M_AND_SPEED = ("m", "m/s")


def step(x: Array, v: Array, dt: float, string: Any, scheme: str, clock: str = "dt", **law: Any) -> tuple[Array, Array]:
    """One step of a string by a scheme, of the catalogue or of those below.

    Args:
        clock: what the scheme takes for dt: dt, its square, 1, or half of it.
        law: parameters of `links.forces` and `LinkMotion`.
    """
    took = {"dt": dt, "twice": dt * dt, "none": 1.0, "half": dt / 2, "double": 2 * dt}[clock]
    end = _advance(scheme)(LinkMotion(string, **law), State(0.0, x, v), took)
    return end.positions, end.velocities


@cache
def _advance(scheme: str) -> Step:
    return STEPS.get(scheme) or catalogue.find(scheme).step


def _slopes(motion: Motion, state: State, dt: float) -> tuple[Array, Array, Array, Array]:
    """The slopes here and at Euler's guess: velocities and accelerations."""
    here, there = motion.slope(state), motion.slope(state + dt * motion.slope(state))
    return here.positions, here.velocities, there.positions, there.velocities


def _moved(state: State, dt: float, by_x: Array, by_v: Array) -> State:
    return State(state.time + dt, state.positions + by_x, state.velocities + by_v)


def midpoint(motion: Motion, state: State, dt: float) -> State:
    """The slope half-way (Runge 1895)."""
    return state + dt * motion.slope(state + dt / 2 * motion.slope(state))


def ralston(motion: Motion, state: State, dt: float) -> State:
    """Slopes here and at two thirds, weighted 1 and 3 (Ralston 1962)."""
    here = motion.slope(state)
    return state + dt / 4 * (here + 3 * motion.slope(state + 2 / 3 * dt * here))


def without_half(motion: Motion, state: State, dt: float) -> State:
    """The sum of two slopes in place of their average."""
    v0, a0, v1, a1 = _slopes(motion, state, dt)
    return _moved(state, dt, dt * (v0 + v1), dt * (a0 + a1))


def half_of_one(motion: Motion, state: State, dt: float) -> State:
    """Only the second slope is halved: a bracket is missing."""
    v0, a0, v1, a1 = _slopes(motion, state, dt)
    return _moved(state, dt, dt * (v0 + v1 / 2), dt * (a0 + a1 / 2))


def wrong_pair(motion: Motion, state: State, dt: float) -> State:
    """The average of the slope here and the one half-way."""
    here = motion.slope(state)
    return state + dt / 2 * (here + motion.slope(state + dt / 2 * here))


def crossed_pair(motion: Motion, state: State, dt: float) -> State:
    """Velocities by the average acceleration, positions by the average of the old and the corrected velocity."""
    _, a0, _, a1 = _slopes(motion, state, dt)
    new = state.velocities + dt / 2 * (a0 + a1)
    return State(state.time + dt, state.positions + dt / 2 * (state.velocities + new), new)


def end_slope(motion: Motion, state: State, dt: float) -> State:
    """The slope at the guess alone."""
    _, _, v1, a1 = _slopes(motion, state, dt)
    return _moved(state, dt, dt * v1, dt * a1)


def from_guess(motion: Motion, state: State, dt: float) -> State:
    """The average slope, but added to the guess."""
    v0, a0, v1, a1 = _slopes(motion, state, dt)
    return _moved(state, dt, dt * v0 + dt / 2 * (v0 + v1), dt * a0 + dt / 2 * (a0 + a1))


def positions_by_euler(motion: Motion, state: State, dt: float) -> State:
    """Only the velocities are corrected."""
    v0, a0, _, a1 = _slopes(motion, state, dt)
    return _moved(state, dt, dt * v0, dt / 2 * (a0 + a1))


def velocities_by_euler(motion: Motion, state: State, dt: float) -> State:
    """Only the positions are corrected."""
    v0, a0, v1, _ = _slopes(motion, state, dt)
    return _moved(state, dt, dt / 2 * (v0 + v1), dt * a0)


def new_velocity(motion: Motion, state: State, dt: float) -> State:
    """Heun's velocities, and positions that move with the new ones."""
    _, a0, _, a1 = _slopes(motion, state, dt)
    new = state.velocities + dt / 2 * (a0 + a1)
    return State(state.time + dt, state.positions + dt * new, new)


def guess_of_positions(motion: Motion, state: State, dt: float) -> State:
    """The guess moves the positions and leaves the velocities."""
    here = motion.slope(state)
    there = motion.slope(State(state.time, state.positions + dt * here.positions, state.velocities))
    return state + dt / 2 * (here + there)


def guess_of_velocities(motion: Motion, state: State, dt: float) -> State:
    """The guess moves the velocities and leaves the positions."""
    here = motion.slope(state)
    there = motion.slope(State(state.time, state.positions, state.velocities + dt * here.velocities))
    return state + dt / 2 * (here + there)


def guess_by_kick_drift(motion: Motion, state: State, dt: float) -> State:
    """The guess moves its positions with its own new velocities."""
    here = motion.slope(state)
    new = state.velocities + dt * here.velocities
    there = motion.slope(State(state.time, state.positions + dt * new, new))
    return state + dt / 2 * (here + there)


def old_velocity_in_force(motion: Motion, state: State, dt: float) -> State:
    """The force at the guess takes the velocities that there were."""
    here = motion.slope(state)
    guess = state + dt * here
    force = motion.acceleration(State(state.time, guess.positions, state.velocities))
    return _moved(state, dt, dt / 2 * (state.velocities + guess.velocities), dt / 2 * (here.velocities + force))


def velocities_without_dt(motion: Motion, state: State, dt: float) -> State:
    """Euler's step, but the velocities take the whole acceleration."""
    return _moved(state, dt, dt * state.velocities, motion.acceleration(state))


def positions_without_dt(motion: Motion, state: State, dt: float) -> State:
    """Euler's step, but the positions take the whole velocity."""
    return _moved(state, dt, state.velocities, dt * motion.acceleration(state))


def still_positions(motion: Motion, state: State, dt: float) -> State:
    """Positions stay."""
    return State(state.time + dt, state.positions, state.velocities + dt * motion.acceleration(state))


def still_velocities(motion: Motion, state: State, dt: float) -> State:
    """Velocities stay."""
    return State(state.time + dt, state.positions + dt * state.velocities, state.velocities)


def velocity_replaced(motion: Motion, state: State, dt: float) -> State:
    """The velocity is set to dt a, the one before is lost."""
    return State(state.time + dt, state.positions + dt * state.velocities, dt * motion.acceleration(state))


def nothing(motion: Motion, state: State, dt: float) -> State:
    """Nothing happens."""
    return State(state.time + dt, np.array(state.positions), np.array(state.velocities))


#: By name.
STEPS: dict[str, Step] = {
    function.__name__: function
    for function in [
        midpoint,
        ralston,
        without_half,
        half_of_one,
        wrong_pair,
        crossed_pair,
        end_slope,
        from_guess,
        positions_by_euler,
        velocities_by_euler,
        new_velocity,
        guess_of_positions,
        guess_of_velocities,
        guess_by_kick_drift,
        old_velocity_in_force,
        velocities_without_dt,
        positions_without_dt,
        still_positions,
        still_velocities,
        velocity_replaced,
        nothing,
    ]
}
