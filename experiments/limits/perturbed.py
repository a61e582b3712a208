"""About which equilibrium a stepper is perturbed, and the system it then starts from.

An engine is started at its own equilibrium: one that cannot start with stretched springs, or takes them for rods, hangs
as a pendulum.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from engines.engine import Engine
from experiments.runs.claims import claimed
from reference.errors import InputError, SolverError
from reference.limit import Limit
from reference.measured_stability import PERTURBATION
from reference.outcome import Outcome
from reference.pendulum import why_no_pendulum
from reference.state import Array, State
from reference.stepper import SchemeStepper
from reference.system import MassSpringSystem
from reference.theory.equilibria import Equilibrium, equilibrium_of, pendulum_equilibrium
from reference.theory.parts import falling_velocities


def rest_of_scheme(stepper: SchemeStepper, system: MassSpringSystem, rest: Equilibrium) -> Equilibrium | Limit:
    """Where a scheme's system is at rest, with rods if it steps rods; where there is no rest, no limit and why.

    Args:
        rest: the equilibrium of the springs.
    """
    try:
        return equilibrium_of(stepper.equations, system) if stepper.on_rods else rest
    except (InputError, SolverError) as error:
        return Limit(None, f"{stepper.name} has no rest to be predicted about: {error}")


def rest_of_engine(engine: Engine, system: MassSpringSystem, rest: Equilibrium) -> Equilibrium | Outcome:
    """The equilibrium an engine can be started at: of the springs, or of the rods that it takes them for."""
    scheme = claimed(engine)
    on_rods = scheme is not None and scheme.on_rods
    if "stretched" in engine.capabilities and not on_rods:
        return rest
    reason = why_no_pendulum(system)
    if reason:
        return Outcome("unsupported", f"{engine.name} puts rods for springs, whose rest is not known here: {reason}")
    return pendulum_equilibrium(system)


def perturbed(system: MassSpringSystem, rest: Equilibrium) -> tuple[Array, MassSpringSystem]:
    """Where all masses are at rest [m], and the system with every free mass (or angle) moved a little, at random.

    What nothing holds falls steadily there.
    """
    x = rest.state.positions.copy()
    x[rest.free] += PERTURBATION * rest.scale * np.random.default_rng(0).standard_normal(x[rest.free].shape)
    states = [rest.state, State(0.0, x, np.zeros_like(x))]
    at_rest, moved = rest.motion.trajectory(states).positions
    return at_rest, replace(system, positions=moved, velocities=falling_velocities(system))
