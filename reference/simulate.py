"""A scheme, step after step: from a system to its trajectory."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from reference.catalogue import Scheme
from reference.changes import Change, changes_by_step, whole_steps
from reference.forces import SpringMotion
from reference.motion import Motion
from reference.obstacles import keep_out
from reference.state import State, Trajectory
from reference.system import MassSpringSystem


def simulate(
    system: MassSpringSystem,
    scheme: Scheme,
    dt: float,
    duration: float,
    changes: Sequence[Change] = (),
    equations: Callable[[MassSpringSystem], Motion] = SpringMotion,
) -> Trajectory:
    """The trajectory of a system under a scheme, with parameters that may change on the fly (slide 12).

    The state advances as a whole; then masses inside obstacles are pushed out (slide 17), and that is the new state.

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
    """
    steps = whole_steps(dt, duration)
    pending = changes_by_step(changes, dt)
    motion = equations(system)
    state = motion.start
    states = [state]
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        for i in range(steps):
            for change in pending.get(i, ()):
                system = system.with_parameter(change.parameter, change.value)
                motion = equations(system)
            state = scheme.step(motion, state, dt)
            x, v = state.positions, state.velocities
            if system.obstacles:
                x, v = keep_out(system.obstacles, system.fixed[:, None], x, v)
            state = State((i + 1) * dt, x, v)
            states.append(state)
            if not (np.isfinite(state.positions).all() and np.isfinite(state.velocities).all()):
                break
        return motion.trajectory(states)
