"""A mass on the cursor: one more fixed mass, at the cursor, and one more spring to it; and masses pinned or let go."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from reference.state import Array, State
from reference.system import MassSpringSystem

#: The cursor's spring is this part of the stiffest on the mass, so that it changes what is stable little.
SOFTNESS = 0.2

#: Its rest length, as a part of the system's size: a spring of no length has no direction.
LENGTH = 0.02


def with_cursor(system: MassSpringSystem, mass: int, place: Array) -> MassSpringSystem:
    """The system with a mass that hangs on a spring from just above a place [m], shape (d,)."""
    own = (system.springs == mass).any(axis=1)
    stiffness = SOFTNESS * float(system.stiffness[own if own.any() else slice(None)].max(initial=1.0))
    length = LENGTH * system.size
    n = len(system.masses)
    return replace(
        system,
        positions=np.vstack([system.positions, hook(system, place)]),
        velocities=np.vstack([system.velocities, np.zeros(system.dimension)]),
        masses=np.append(system.masses, system.masses[mass]),
        fixed=np.append(system.fixed, True),
        pulls=np.vstack([system.pulls, np.zeros(system.dimension)]),
        springs=np.vstack([system.springs, [mass, n]]),
        rest_lengths=np.append(system.rest_lengths, length),
        stiffness=np.append(system.stiffness, stiffness),
        damping=np.append(system.damping, 0.0),
        broken=np.append(system.broken, False),
        nonlinear=system.nonlinear and system.nonlinear.followed_by_linear(1),
    )


def hook(system: MassSpringSystem, place: Array) -> Array:
    """Where the cursor's spring ends for the mass to be at a place: its rest length higher, shape (d,) [m]."""
    return np.asarray(place + LENGTH * system.size * np.eye(system.dimension)[system.vertical_axis])


def on_hook(state: State, hook: Array) -> State:
    """The state with one more mass, at rest at the hook."""
    return State(state.time, np.vstack([state.positions, hook]), np.vstack([state.velocities, 0 * hook]))


def without_last(state: State) -> State:
    """The state without its last mass."""
    return State(state.time, state.positions[:-1], state.velocities[:-1])


def pinned(system: MassSpringSystem, mass: int) -> MassSpringSystem:
    """The system with a mass fixed that was free, or free that was fixed."""
    fixed = system.fixed.copy()
    fixed[mass] = not fixed[mass]
    return replace(system, fixed=fixed, velocities=np.where(fixed[:, None], 0.0, system.velocities))


def at_rest_where_fixed(system: MassSpringSystem, state: State) -> State:
    """The state with no velocity where a mass is fixed."""
    return State(state.time, state.positions, np.where(system.fixed[:, None], 0.0, state.velocities))
