"""What theory predicts of steppers on one system: each scheme's limit once, an engine's by what it is identified as."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from engines.process.isolation import EngineStepper
from experiments.limits.perturbed import rest_of_scheme
from reference.identification import Identification, identify_all
from reference.limit import Limit
from reference.outcome import Outcome
from reference.stepper import SchemeStepper, stepper_named
from reference.system import MassSpringSystem
from reference.theory.equilibria import Equilibrium
from reference.theory.limits import stability_limit
from reference.theory.rates import Rates, rates

#: An engine is identified from this many steps, at a tenth of what the fastest mode allows.
IDENTIFYING_STEPS = 200


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
            about = self.about(stepper)
            limit = about if isinstance(about, Limit) else stability_limit(stepper.scheme, *about)
            self._limits[stepper.name] = limit
        return self._limits[stepper.name]

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


def named(found: Identification) -> SchemeStepper | None:
    """The scheme that an engine was identified with."""
    return None if found.identified_as is None else stepper_named(found.identified_as)
