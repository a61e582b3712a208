"""A scheme, step after step: from a system to its trajectory."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from reference.changes import Change, applied, changes_by_step, whole_steps
from reference.collisions.impacts import collide
from reference.compiled.in_place import step_of
from reference.forces import SpringMotion
from reference.jit import compiled
from reference.motion import EquationsOf
from reference.obstacles import project_out
from reference.schemes.catalogue import Scheme
from reference.springs.breaking import after_breaking
from reference.state import Array, State, Trajectory
from reference.system import MassSpringSystem


def simulate(
    system: MassSpringSystem,
    scheme: Scheme,
    dt: float,
    duration: float,
    changes: Sequence[Change] = (),
    equations: EquationsOf = SpringMotion,
) -> Trajectory:
    """The trajectory of a system under a scheme, with parameters that may change on the fly (slide 12).

    Args:
        dt: the step [s].
        duration: how long [s]; the nearest whole number of steps is taken.
        changes: parameters to change while it moves.
        equations: what to make of the system; `pendulum.PendulumMotion` hangs rods in place of the springs.

    Returns:
        The start and every step after it. Ends early at the first state that is not finite.

    Raises:
        InputError: for a dt or duration that is not a positive number; for rods with obstacles (`pendulum`).
        SolverError: if the scheme is implicit and finds no solution.
        Unsupported: where the scheme needs what the equations do not give.
    """
    steps = whole_steps(dt, duration)
    pending = changes_by_step(changes, dt)
    motion = equations(system)
    state = motion.start
    states = [state]
    step = step_of(scheme, motion, steps)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        for i in range(steps):
            for change in pending.get(i, ()):
                system, state = applied(change, system, state)
                motion = equations(system)
                step = step_of(scheme, motion, steps - i)
            state = projected(system, step(state, dt), (i + 1) * dt)
            states.append(state)
            if system.nonlinear is not None and (left := after_breaking(system, state)) is not system:
                system = left
                motion = equations(system)
                step = step_of(scheme, motion, steps - i)
            if not (_all_finite(state.positions) and _all_finite(state.velocities)):
                break
        return motion.trajectory(states)


def projected(system: MassSpringSystem, state: State, time: float) -> State:
    """The end of every step, at a time [s] on the clock: masses inside obstacles (slide 17) or one another are put out.

    What a multistep scheme remembers stays as it is.
    """
    x, v = state.positions, state.velocities
    if system.obstacles:
        x, v = project_out(system.obstacles, system.fixed[:, None], x, v)
    if system.collisions is not None:
        x, v = collide(system.collisions, np.where(system.fixed, 0.0, 1 / system.masses), x, v)
    return State(time, x, v, state.memory)


def all_finite(numbers: Array) -> bool:
    """Whether all are numbers, of an array of any shape: after every step that is asked, of few numbers mostly."""
    found = True
    for number in numbers.flat:
        found &= np.isfinite(number)
    return found


(_all_finite,) = compiled(all_finite)
