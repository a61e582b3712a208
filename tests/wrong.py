"""Deliberately wrong integrators: what every physics check must be seen to refuse.

Each is a step like those of the catalogue, wrapped as a `Scheme` with the order of what it pretends to be, and not
entered there. Its docstring says the mistake; but for that one mistake each is right.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from reference.assembly import solve_velocities
from reference.forces import SpringMotion
from reference.motion import Motion, MotionByMass, MotionOfSprings
from reference.schemes.catalogue import Kind, Scheme, Step
from reference.state import Array, State


def wrong(order: int, kind: Kind = "scheme") -> Callable[[Step], Scheme]:
    """Wrap the decorated step as a scheme that claims an order."""

    def wrap(step: Step) -> Scheme:
        return Scheme(step, order, kind)

    return wrap


# Mistakes in the scheme.


@wrong(order=1)
def backward_euler_stopped_early(motion: MotionOfSprings, state: State, dt: float) -> State:
    """Backward Euler's Newton stops once velocities change by a millionth, in place of a billionth."""
    end, change = state.drift(dt), np.inf
    while change > 1e-6 * np.abs(end.velocities).max():
        by_position, by_velocity = motion.jacobians(end)
        missing = state.velocities + dt * motion.acceleration(end) - end.velocities
        more = solve_velocities(motion.system, dt * by_velocity + dt**2 * by_position, missing)
        velocities, change = end.velocities + more, np.abs(more).max()
        end = State(end.time, state.positions + dt * velocities, velocities)
    return end


@wrong(order=2)
def heun_without_half(motion: Motion, state: State, dt: float) -> State:
    """Heun adds the two slopes and forgets to halve the sum: every step advances two dt."""
    here = motion.slope(state)
    return state + dt * (here + motion.slope(state + dt * here))


@wrong(order=2)
def heun_of_the_wrong_pair(motion: Motion, state: State, dt: float) -> State:
    """Heun averages the slope here with the one half-way in place of the one at the end."""
    here = motion.slope(state)
    return state + dt / 2 * (here + motion.slope(state + dt / 2 * here))


@wrong(order=2)
def verlet_with_one_force(motion: Motion, state: State, dt: float) -> State:
    """Velocity Verlet uses the acceleration at the start for both halves of the velocity's step."""
    here = motion.acceleration(state)
    return state.kick(dt / 2 * here).drift(dt).kick(dt / 2 * here)


@wrong(order=4)
def rk4_equally_weighted(motion: Motion, state: State, dt: float) -> State:
    """Runge-Kutta weighs its four slopes 1, 1, 1, 1 in place of 1, 2, 2, 1: order 2."""
    first = motion.slope(state)
    second = motion.slope(state + dt / 2 * first)
    third = motion.slope(state + dt / 2 * second)
    fourth = motion.slope(state + dt * third)
    return state + dt / 4 * (first + second + third + fourth)


@wrong(order=1)
def kick_drift_kicked_twice(motion: Motion, state: State, dt: float) -> State:
    """Kick-drift kicks with 2 dt."""
    return state.kick(2 * dt * motion.acceleration(state)).drift(dt)


@wrong(order=1)
def explicit_in_place_of_backward(motion: Motion, state: State, dt: float) -> State:
    """Backward Euler takes the slope at Euler's guess of the end and does not iterate."""
    return state + dt * motion.slope(state + dt * motion.slope(state))


@wrong(order=2)
def heun_back_in_time(motion: Motion, state: State, dt: float) -> State:
    """Heun with the step's sign turned: the clock goes on, the masses go back."""
    here = motion.slope(state)
    back = state + -dt / 2 * (here + motion.slope(state + -dt * here))
    return State(state.time + dt, back.positions, back.velocities)


@wrong(order=1)
def last_mass_forgotten(motion: Motion, state: State, dt: float) -> State:
    """Kick-drift whose loop ends one too early: the last mass never moves."""
    end = state.kick(dt * motion.acceleration(state)).drift(dt)
    end.positions[-1], end.velocities[-1] = state.positions[-1], state.velocities[-1]
    return end


@wrong(order=1)
def kick_drift_gaining_energy(motion: Motion, state: State, dt: float) -> State:
    """Kick-drift whose velocities grow by a part in a million at each step."""
    return state.kick(dt * motion.acceleration(state) + 1e-6 * state.velocities).drift(dt)


@wrong(order=1)
def in_order_of_number(motion: MotionByMass, state: State, dt: float) -> State:
    """Kick-drift, mass by mass: each looks at those before it where they have already moved to."""
    end = State(state.time + dt, state.positions.copy(), state.velocities.copy())
    for i in range(len(end.positions)):
        end.velocities[i] += dt * motion.acceleration_of(i, end)
        end.positions[i] += dt * end.velocities[i]
    return end


# Mistakes in the forces, stepped by right schemes.


def gravity_turned(motion: SpringMotion, state: State) -> Array:
    """Gravity points upwards."""
    free = ~motion.system.fixed[:, None]
    return np.where(free, motion.acceleration(state) - 2 * motion.system.gravity, 0.0)


def damping_turned(motion: SpringMotion, state: State) -> Array:
    """The damping of the springs and the drag drive the motion."""
    resting = State(state.time, state.positions, np.zeros_like(state.velocities))
    return 2 * motion.acceleration(resting) - motion.acceleration(state)


def one_sided(motion: SpringMotion, state: State) -> Array:
    """Every spring pulls its first mass only."""
    system = motion.system
    accelerations = np.tile(system.gravity, (len(system.masses), 1))
    first = system.springs[:, 0]
    np.add.at(accelerations, first, spring_forces(motion, state) / system.masses[first, None])
    return np.where(system.fixed[:, None], 0.0, accelerations - system.drag * state.velocities / system.masses[:, None])


def sideways(motion: SpringMotion, state: State) -> Array:
    """Every spring also pushes its two masses sideways, with opposite forces: momentum is kept, its moment is not."""
    system = motion.system
    accelerations = motion.acceleration(state)
    for (a, b), pull in zip(system.springs.tolist(), spring_forces(motion, state), strict=True):
        across = 1e-3 * np.roll(pull, 1) * np.array([-1.0, 1.0, 0.0][: system.dimension])
        accelerations[a] += across / system.masses[a]
        accelerations[b] -= across / system.masses[b]
    return np.where(system.fixed[:, None], 0.0, accelerations)


def slightly_stronger(motion: SpringMotion, state: State) -> Array:
    """All forces are too large by a part in 1e9."""
    return (1 + 1e-9) * motion.acceleration(state)


def spring_forces(motion: SpringMotion, state: State) -> Array:
    """The force of each spring on its first mass [N], shape (s, d), by the formula of `reference.forces`."""
    system = motion.system
    a, b = system.springs.T
    gap = state.positions[b] - state.positions[a]
    length = np.linalg.norm(gap, axis=1, keepdims=True)
    along = gap / length
    lengthening = (along * (state.velocities[b] - state.velocities[a])).sum(axis=1)
    force = system.stiffness * (length[:, 0] - system.rest_lengths) + system.damping * lengthening
    return np.asarray(force[:, None] * along)


#: What a wrong force law gives: the accelerations of all masses [m/s^2].
Law = Callable[[SpringMotion, State], Array]


class WrongMotion(SpringMotion):
    """Equations of motion with one of the wrong laws above; for `equations=` take `under(law)`."""

    law: Law

    def acceleration(self, state: State, damping: bool = True) -> Array:
        """The wrong accelerations; damping cannot be left out."""
        return type(self).law(SpringMotion(self.system), state)


def under(law: Law) -> type[WrongMotion]:
    """The equations of motion under a wrong law."""
    return type(law.__name__, (WrongMotion,), {"law": staticmethod(law), "__doc__": law.__doc__})


def stepped(law: Law, scheme: Scheme) -> Scheme:
    """A right scheme stepping under a wrong law."""

    def step(motion: MotionOfSprings, state: State, dt: float) -> State:
        return scheme.step(under(law)(motion.system), state, dt)

    step.__name__ = f"{scheme.name}_with_{law.__name__}"
    step.__doc__ = law.__doc__
    # A law needs the springs: their ends, lengths and coefficients.
    return Scheme(step, scheme.order, scheme.kind, linear=False)
