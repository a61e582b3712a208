"""Springs that break: which do, when, and how a run is told of it.

The rule is looked at once a step, at its end, after masses are put out of obstacles: a spring that is there stretched
by more than its `breaking_stretch`, or pulls with more than its `breaking_force` (its damper's part included), is gone
from the next step on, for good. So it is the same rule for a scheme, an engine and the true motion at those times, and
which springs broke, and when, is known of a trajectory of all steps.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from reference.changes import Change, changes_by_step
from reference.lengths import lengths_and_rates
from reference.springs.linear_law import spring_force
from reference.springs.nonlinear_law import damping_at, secant_stiffness, stretches
from reference.state import Array, State, Trajectory
from reference.system import BREAK, BoolArray, IntArray, MassSpringSystem


def tensions(system: MassSpringSystem, positions: Array, velocities: Array) -> Array:
    """The force of every spring [N], tension positive, with masses (..., n, d): shape (..., s)."""
    return stretches_and_tensions(system, positions, velocities)[1]


def stretches_and_tensions(system: MassSpringSystem, positions: Array, velocities: Array) -> tuple[Array, Array]:
    """How far springs are stretched [m], and with which force they pull [N], with masses (..., n, d): both (..., s)."""
    length, rate = lengths_and_rates(positions, velocities, system.springs, system.damping > 0)
    stretch = length - system.rest_lengths
    return stretch, spring_force(secant_stiffness(system, stretch), stretch, damping_at(system, stretch), rate)


def breaking(system: MassSpringSystem, state: State) -> IntArray:
    """The springs that break at a state, as it is at the end of a step."""
    law = system.nonlinear
    if law is None or not law.breaks:
        return np.zeros(0, dtype=np.int64)
    with np.errstate(over="ignore", invalid="ignore"):
        too_far = stretches(system, state.positions) > law.breaking_stretch
        too_much = tensions(system, state.positions, state.velocities) > law.breaking_force
    return np.flatnonzero(too_far | too_much)


def after_breaking(system: MassSpringSystem, state: State) -> MassSpringSystem:
    """The system from the next step on: itself, where nothing breaks."""
    broken = breaking(system, state)
    return system.with_parameter(BREAK, broken.tolist()) if len(broken) else system


def without_force(system: MassSpringSystem) -> BoolArray:
    """Which springs pull with nothing whatever their masses do: those that are broken, and any that never did."""
    forceless = (system.stiffness == 0) & (system.damping == 0)
    return np.asarray(forceless if system.nonlinear is None else forceless & (system.nonlinear.hardening == 0))


def breaks_of(system: MassSpringSystem, motion: Trajectory, dt: float, changes: Sequence[Change] = ()) -> list[Change]:
    """Which springs broke in a run, as changes at the times of the steps at whose ends they did.

    Args:
        motion: of every step of dt [s], from the start on.
        changes: of parameters on the way.
    """
    if system.nonlinear is None or not system.nonlinear.breaks:
        return []
    pending, found = changes_by_step(changes, dt), []
    for step, state in enumerate(motion.states()):
        broken = breaking(system, state)
        if step and len(broken):
            found.append(Change(step * dt, BREAK, tuple(map(float, broken))))
            system = system.with_parameter(BREAK, broken.tolist())
        for change in pending.get(step, ()):
            system = system.with_parameter(change.parameter, change.value)
    return found
