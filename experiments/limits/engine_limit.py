"""An engine's stability limit, measured in a process of its own.

Where theory knows which scheme the engine is, it says which mode to perturb and where to look: runs at steps a little
below the predicted limit and above it show growth of a millionth in a step. Where it does not, or the engine cannot be
started so, a random perturbation is watched in longer runs, from short steps on.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import floor, log, log1p, sqrt

import numpy as np

from engines.engine import precision as precision_of
from engines.measured_limit import ModeRun, growths_along_modes, limit_of_engine
from engines.process.isolation import EngineStepper
from experiments.limits.perturbed import perturbed, rest_of_engine
from experiments.limits.predictions import Predictions
from reference.errors import SolverError
from reference.forces import SpringMotion
from reference.limit import Limit
from reference.measured_stability import PERTURBATION
from reference.outcome import Outcome
from reference.state import State
from reference.stepper import SchemeStepper
from reference.system import MassSpringSystem
from reference.theory.equilibria import Equilibrium
from reference.theory.layout import layout_of
from reference.theory.measured_mode import WHOLE_UP_TO, fastest_mode_of_step
from reference.theory.rates import Rates

#: Limits are found to this part of themselves.
PRECISION = 1e-4

#: The steps at which runs are made are whole powers of 1 + PRECISION, so far from the one below the predicted limit:
#: where to look is expected, what is found is not.
LADDER = (-1000, -300, -100, -10, -1, 0, 1, 2, 10, 100, 300, 1000)

#: Growth in a step that is more than rounding and what is not linear, and the size of a perturbation as a part of the
#: shortest spring: in double and in single precision.
MARGIN = {"double": 2e-8, "single": 2e-4}
SIZE = {"double": PERTURBATION, "single": 1e-3}

#: By what both are larger for a scheme that stops iterating at velocities that count as none.
ITERATED = 30.0


def measure_engine(
    stepper: EngineStepper, predictions: Predictions, scheme: SchemeStepper | None, predicted: Limit
) -> Limit | Outcome:
    """An engine's limit about the equilibrium it can have; or the outcome that says why not.

    Args:
        predictions: of the system.
        scheme, predicted: what the engine was identified as, None where it was not; and its limit.
    """
    if stepper.version is None:
        return Outcome("unsupported", f"{stepper.engine.package} is not installed")
    own_rest = rest_of_engine(stepper.engine, predictions.system, predictions.rest)
    if isinstance(own_rest, Outcome):
        return own_rest
    along = _along_modes(stepper, predictions, own_rest, scheme, predicted) if scheme is not None else None
    return along or measure_at_random(stepper, predictions.system, predictions.rest, predictions.unit)


def measure_at_random(
    stepper: EngineStepper, system: MassSpringSystem, rest: Equilibrium, dt: float, precision: float = PRECISION
) -> Limit | Outcome:
    """The same from random perturbations and from short steps on, with nothing of the theory in it but the rest.

    Args:
        rest: of the system's springs.
        dt: about as long as the fastest mode lasts [s].
        precision: as a part of the limit.
    """
    own_rest = rest_of_engine(stepper.engine, system, rest)
    if isinstance(own_rest, Outcome):
        return own_rest
    asked = (stepper.engine, *perturbed(system, own_rest), dt, precision)
    return stepper.isolate(limit_of_engine, *asked, time_limit=2 * stepper.time_limit)


def _along_modes(
    stepper: EngineStepper, predictions: Predictions, rest: Equilibrium, scheme: SchemeStepper, predicted: Limit
) -> Limit | Outcome | None:
    """From runs along modes at steps around the predicted limit; None where these do not tell."""
    system, found = predictions.system, predictions.rates
    engine = stepper.engine
    able = isinstance(rest.motion, SpringMotion) and {"stretched", "velocities"} <= engine.capabilities
    if not able or scheme.on_rods or not predicted.exact or predicted.note or predicted.dt is None:
        return None
    if layout_of(scheme.scheme, rest, predicted.dt)[0].size > WHOLE_UP_TO:
        return None
    larger = ITERATED if scheme.scheme.iterated else 1.0
    size = larger * SIZE[precision_of(engine)] * rest.scale
    below = floor(log(predicted.dt) / log1p(PRECISION))
    steps = [(1 + PRECISION) ** (below + further) for further in LADDER]
    runs = [_mode_run(scheme, rest, dt, size, found) for dt in steps]
    if any(run is None for run in runs):
        return None
    at_rest = replace(system, positions=rest.state.positions, velocities=np.zeros_like(rest.state.positions))
    limit = 2 * stepper.time_limit
    answer = stepper.isolate(growths_along_modes, engine, at_rest, runs, time_limit=limit)
    if isinstance(answer, Outcome):
        return answer
    growths = answer["growth"].tolist()
    first = _first_unstable(growths, larger * MARGIN[precision_of(engine)])
    if first is None:
        return None
    factors = (1 + growths[LADDER.index(-100)], 1 + growths[LADDER.index(100)])
    return Limit(sqrt(steps[first - 1] * steps[first]), factors=factors, grows_beyond=True)


def _mode_run(scheme: SchemeStepper, rest: Equilibrium, dt: float, size: float, found: Rates) -> ModeRun | None:
    """The scheme's fastest mode at a dt, as a perturbation [m]."""
    try:
        mode = fastest_mode_of_step(scheme.scheme, rest, dt, found)
    except (SolverError, np.linalg.LinAlgError):
        return None
    if mode is None:
        return None
    nothing = np.zeros_like(rest.state.positions)
    layout, _ = layout_of(scheme.scheme, rest, dt)
    whole = layout.state(mode.shape * (size / np.abs(mode.shape).max()), State(0.0, nothing, nothing))
    return ModeRun(dt, whole.positions, whole.velocities, mode.left)


def _first_unstable(growths: Sequence[float], margin: float) -> int | None:
    """The first of the runs in which the mode grew; None unless none before and all after did, and both there are."""
    grows = [not growth <= margin for growth in growths]
    if grows != sorted(grows) or grows[0] or not grows[-1]:
        return None
    return grows.index(True)
