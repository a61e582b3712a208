"""An engine's stability limit, measured in a process of its own.

Where theory knows which scheme the engine is, it says which mode to perturb and where to look: runs at steps a little
below the predicted limit and above it show growth of a millionth in a step. Where it does not, or the engine cannot be
started so, a random perturbation is watched in longer runs, from short steps on.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import floor, log, log1p

import numpy as np

from engines.engine import absence
from engines.engine import precision as precision_of
from engines.measured_limit import MODE_STEPS, ModeRun, growths_along_modes, limit_of_engine
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
from reference.theory.measured_mode import WHOLE_UP_TO, FastestMode, fastest_mode_of_step
from reference.theory.parts import falling_velocities, parts_of
from reference.theory.rates import Rates

#: Limits are found to this part of themselves.
PRECISION = 1e-4

#: The steps at which runs are made are whole powers of 1 + PRECISION, so far from the one below the predicted limit:
#: where to look is expected, what is found is not. The second are looked at where the first do not tell.
LADDERS = ((-100, 0, 1, 100), (-1000, -100, 0, 1, 100, 1000))

#: Between two of them that are no neighbours, so many further ones at once are run, evenly spread.
BETWEEN = 7

#: Growth in a step that is more than rounding and what is not linear, and the size of a perturbation as a part of the
#: shortest spring: in double and in single precision.
MARGIN = {"double": 2e-8, "single": 2e-4}
SIZE = {"double": PERTURBATION, "single": 1e-3}

#: Why an engine in single precision has no limit where runs along a mode tell none.
HIDDEN = "not measured: in single precision rounding hides how random perturbations grow, and no mode is known to run"

#: Growth so many times as large is told from none in any engine; between, in those that round little.
CERTAIN = 10.0

#: Where growth at any dt is predicted, an engine is run at these parts of the fastest mode's 1/w.
TRIED = (0.1, 1.0)

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
        return Outcome("unsupported", absence(stepper.engine))
    own_rest = rest_of_engine(stepper.engine, predictions.system, predictions.rest)
    if isinstance(own_rest, Outcome):
        return own_rest
    along = _along_modes(stepper, predictions, own_rest, scheme, predicted) if scheme is not None else None
    if along is None and precision_of(stepper.engine) == "single":
        return Limit(None, HIDDEN)
    expected = predicted.dt if predicted.exact else None
    return along or measure_at_random(
        stepper, predictions.system, predictions.rest, predictions.unit, expected=expected
    )


def measure_at_random(
    stepper: EngineStepper,
    system: MassSpringSystem,
    rest: Equilibrium,
    dt: float,
    precision: float = PRECISION,
    expected: float | None = None,
) -> Limit | Outcome:
    """The same from random perturbations, from short steps on; where nothing is expected, with no theory but the rest.

    Args:
        rest: of the system's springs.
        dt: about as long as the fastest mode lasts [s].
        precision: as a part of the limit.
        expected: the limit [s] of the scheme that the engine was identified with: it is looked at first.
    """
    own_rest = rest_of_engine(stepper.engine, system, rest)
    if isinstance(own_rest, Outcome):
        return own_rest
    asked = (stepper.engine, *perturbed(system, own_rest), dt, precision, expected)
    return stepper.isolate(limit_of_engine, *asked, time_limit=2 * stepper.time_limit)


def _along_modes(
    stepper: EngineStepper, predictions: Predictions, rest: Equilibrium, scheme: SchemeStepper, predicted: Limit
) -> Limit | Outcome | None:
    """From runs along modes at steps around the predicted limit, or at a few; None where these do not tell."""
    engine, found = stepper.engine, predictions.rates
    able = isinstance(rest.motion, SpringMotion) and {"stretched", "velocities"} <= engine.capabilities
    if not able or scheme.on_rods or predicted.note:
        return None
    if layout_of(scheme.scheme, rest, predictions.unit)[0].size > WHOLE_UP_TO:
        return None
    larger = ITERATED if scheme.scheme.iterated else 1.0
    watched = _Watched(stepper, predictions, rest, scheme, larger * SIZE[precision_of(engine)] * rest.scale)
    margin = larger * MARGIN[precision_of(engine)]
    if predicted.dt is None:
        return _unstable_at_any(watched, margin) if predicted.growth is not None else None
    if not predicted.exact:
        return None
    above = fastest_mode(scheme, rest, (1 + PRECISION) * predicted.dt, found)
    slow = None
    if above is not None and above.growth < CERTAIN * margin:
        beyond = f"growth at {1 + PRECISION:g} of the predicted limit is {above.growth:.1g} a step"
        slow = Limit(None, f"not measured: {beyond}, too slow for a run of {MODE_STEPS} steps")
        if above.growth < margin:
            return slow
    below = floor(log(predicted.dt) / log1p(PRECISION))

    def growths_at(rungs: Sequence[int]) -> list[float] | Outcome | None:
        return watched.growths([(1 + PRECISION) ** (below + rung) for rung in rungs])

    factors, ladders = None, list(LADDERS)
    while ladders:
        rungs = ladders.pop(0)
        growths = growths_at(rungs)
        if growths is None or isinstance(growths, Outcome):
            return growths
        factors = factors or (1 + growths[rungs.index(-100)], 1 + growths[rungs.index(100)])
        first = _first_unstable(growths, margin)
        if first is None:
            continue
        low, high = rungs[first - 1], rungs[first]
        if high - low == 1:
            return Limit((1 + PRECISION) ** (below + low + 0.5), factors=factors, grows_beyond=True)
        ladders = [tuple(sorted({round(rung) for rung in np.linspace(low, high, BETWEEN + 2)}))]
    return slow


@dataclass(frozen=True)
class _Watched:
    """An engine, to be watched in the fastest mode of the scheme it is, perturbed by so much [m]."""

    stepper: EngineStepper
    predictions: Predictions
    rest: Equilibrium
    scheme: SchemeStepper
    size: float

    def growths(self, steps: Sequence[float]) -> list[float] | Outcome | None:
        """In a step, at each of the dts [s]; None where there is no such mode."""
        runs = [self._mode_run(dt) for dt in steps]
        if any(run is None for run in runs):
            return None
        positions = self.rest.state.positions
        system = self.predictions.system
        at_rest = replace(system, positions=positions, velocities=falling_velocities(system))
        if not system.drag and not parts_of(system).held.any():
            # in the frame that falls with all of it: else perturbations drown in how far it has fallen
            at_rest = replace(at_rest, gravity=np.zeros(system.dimension))
        limit, engine = 2 * self.stepper.time_limit, self.stepper.engine
        answer = self.stepper.isolate(growths_along_modes, engine, at_rest, runs, time_limit=limit)
        return answer if isinstance(answer, Outcome) else answer["growth"].tolist()

    def _mode_run(self, dt: float) -> ModeRun | None:
        """The mode at a dt, as a perturbation [m]."""
        mode = fastest_mode(self.scheme, self.rest, dt, self.predictions.rates)
        if mode is None:
            return None
        nothing = np.zeros_like(self.rest.state.positions)
        layout, _ = layout_of(self.scheme.scheme, self.rest, dt)
        shape = mode.shape * (self.size / np.abs(mode.shape).max())
        whole = layout.state(shape, State(0.0, nothing, nothing))
        return ModeRun(dt, whole.positions, whole.velocities, mode.left)


def fastest_mode(scheme: SchemeStepper, rest: Equilibrium, dt: float, found: Rates) -> FastestMode | None:
    """The scheme's fastest mode at a dt; None where there is none that can be told."""
    try:
        return fastest_mode_of_step(scheme.scheme, rest, dt, found)
    except (SolverError, np.linalg.LinAlgError):
        return None


def _unstable_at_any(watched: _Watched, margin: float) -> Limit | Outcome | None:
    """Where theory finds growth at any dt: whether it is seen at those that are tried."""
    steps = [part * watched.predictions.unit for part in TRIED]
    growths = watched.growths(steps)
    if growths is None or isinstance(growths, Outcome):
        return growths
    if not all(growth > margin for growth in growths):
        return None
    tried = " and ".join(f"{dt:.2g}" for dt in steps)
    seen = f"unstable at any dt that was tried, {tried} s: grows by {growths[0]:.2g} of itself in the first"
    return Limit(None, seen, growths[0])


def _first_unstable(growths: Sequence[float], margin: float) -> int | None:
    """The first of the runs in which the mode grew; None unless none before and all after did, and both there are."""
    grows = [not growth <= margin for growth in growths]
    if grows != sorted(grows) or grows[0] or not grows[-1]:
        return None
    return grows.index(True)
