"""What theory predicts of steppers on one system: each scheme's limit once, an engine's by what it is identified as."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from engines.process.isolation import EngineStepper, in_this_process
from experiments.limits.perturbed import rest_of_scheme
from experiments.runs.elsewhere import elsewhere
from experiments.runs.task import digest
from reference.identification import Identification, identify_all
from reference.limit import Limit
from reference.outcome import Outcome
from reference.stepper import SchemeStepper, stepper_named
from reference.system import MassSpringSystem
from reference.theory.equilibria import Equilibrium, spring_equilibrium
from reference.theory.limits import stability_limit
from reference.theory.rates import Rates, rates

#: An engine is identified from this many steps, at a tenth of what the fastest mode allows.
IDENTIFYING_STEPS = 200

#: Limits of schemes on rods, by the digest of all they were found from.
LimitsOnRods = Mapping[tuple[SchemeStepper, str], Limit]

_LIMITS_ON_RODS: dict[tuple[SchemeStepper, str], Limit] = {}


class Predictions:
    """Limits of schemes and engines on a system about its equilibrium.

    Attributes:
        system: what moves.
        rest: where its springs are at rest.
        rates: the eigenvalues of the motion there.
    """

    def __init__(self, system: MassSpringSystem, rest: Equilibrium) -> None:
        self.system, self.rest, self.rates = system, rest, rates(rest)
        self._limits: dict[str, Limit] = {}

    @property
    def unit(self) -> float:
        """About as long as the fastest motion lasts [s]."""
        return 1 / (self.rates.fastest or 1.0)

    def about(self, stepper: SchemeStepper) -> tuple[Equilibrium, Rates] | Limit:
        """Where a scheme's system is at rest, and how it moves there; where there is no rest, no limit and why."""
        rest = rest_of_scheme(stepper, self.system, self.rest)
        if isinstance(rest, Limit):
            return rest
        return rest, rates(rest) if stepper.on_rods else self.rates

    def of(self, stepper: SchemeStepper) -> Limit:
        """A scheme's."""
        if stepper.name not in self._limits:
            self._limits[stepper.name] = self._limit_on_rods(stepper) if stepper.on_rods else self._limit(stepper)
        return self._limits[stepper.name]

    def _limit(self, stepper: SchemeStepper) -> Limit:
        about = self.about(stepper)
        return about if isinstance(about, Limit) else stability_limit(stepper.scheme, *about)

    def _limit_on_rods(self, stepper: SchemeStepper) -> Limit:
        """Rods have neither stiffness nor damping: of systems that differ in these only it is found once."""
        rods = replace(self.system, stiffness=np.array(1.0), damping=np.array(0.0))
        key = stepper, digest(rods)
        if key not in _LIMITS_ON_RODS:
            rest = rest_of_scheme(stepper, rods, self.rest)
            _LIMITS_ON_RODS[key] = rest if isinstance(rest, Limit) else stability_limit(stepper.scheme, rest)
        return _LIMITS_ON_RODS[key]

    def of_engine(self, found: Identification) -> Limit:
        """That of the scheme an engine was identified with."""
        scheme = named(found)
        return Limit(None, f"not identified; {found.reason}") if scheme is None else self.of(scheme)

    def identifying_run(self, engine: EngineStepper, steps: int = IDENTIFYING_STEPS) -> Outcome:
        """A run of an engine on the system in short steps."""
        return engine.run(self.system, 0.1 * self.unit, steps)

    def identified(
        self, runs: Iterable[tuple[EngineStepper, Outcome]], steps: int = IDENTIFYING_STEPS
    ) -> Mapping[str, Identification]:
        """Which scheme each engine is, by name, from its `identifying_run`."""
        found = identify_all(list(runs), self.system, 0.1 * self.unit, steps)
        return {each.stepper: each for each in found.each}


@dataclass(frozen=True)
class EnginesLimits:
    """Which schemes engines are on a system, and the limits of these.

    Attributes:
        each: in the engines' order.
        on_rods: all limits on rods that are known by now, of other systems too.
    """

    each: Sequence[tuple[Identification, Limit]]
    on_rods: LimitsOnRods


def limits_of_engines(
    system: MassSpringSystem, runs: Sequence[tuple[EngineStepper, Outcome]], on_rods: LimitsOnRods
) -> EnginesLimits:
    """Which scheme each engine is, from its `identifying_run`, and the limit of that scheme.

    Args:
        on_rods: limits that need not be found again.
    """
    _LIMITS_ON_RODS.update(on_rods)
    predictions = Predictions(system, spring_equilibrium(system))
    identified = predictions.identified(runs)
    found = [identified[engine.name] for engine, _ in runs]
    return EnginesLimits([(each, predictions.of_engine(each)) for each in found], dict(_LIMITS_ON_RODS))


def limits_of_engines_elsewhere(
    system: MassSpringSystem, runs: Sequence[tuple[EngineStepper, Outcome]]
) -> Sequence[tuple[Identification, Limit]]:
    """The same, found in another process, while this one is at something else; here where a stepper cannot travel."""
    if not runs:
        return []
    here = any(engine.isolate is in_this_process for engine, _ in runs)
    known = dict(_LIMITS_ON_RODS)
    found = limits_of_engines(system, runs, known) if here else elsewhere(limits_of_engines, system, runs, known)
    _LIMITS_ON_RODS.update(found.on_rods)
    return found.each


def named(found: Identification) -> SchemeStepper | None:
    """The scheme that an engine was identified with."""
    return None if found.identified_as is None else stepper_named(found.identified_as)
