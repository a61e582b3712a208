"""An engine's stability limit, measured in a process of its own."""

from __future__ import annotations

from engines.measured_limit import limit_of_engine
from engines.process.isolation import EngineStepper
from experiments.limits.perturbed import perturbed, rest_of_engine
from reference.limit import Limit
from reference.outcome import Outcome
from reference.system import MassSpringSystem
from reference.theory.equilibria import Equilibrium

#: Limits are found to this part of themselves.
PRECISION = 1e-4


def measure_engine(
    stepper: EngineStepper, system: MassSpringSystem, rest: Equilibrium, dt: float, precision: float = PRECISION
) -> Limit | Outcome:
    """An engine's limit, from random perturbations about the equilibrium it can have; or the outcome that says why not.

    Args:
        rest: of the system's springs.
        dt: about as long as the fastest mode lasts [s].
        precision: as a part of the limit.
    """
    if stepper.version is None:
        return Outcome("unsupported", f"{stepper.engine.package} is not installed")
    own_rest = rest_of_engine(stepper.engine, system, rest)
    if isinstance(own_rest, Outcome):
        return own_rest
    start = perturbed(system, own_rest)
    return stepper.isolate(limit_of_engine, stepper.engine, *start, dt, precision, time_limit=2 * stepper.time_limit)
