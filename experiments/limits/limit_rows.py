"""Steppers on one system, a row for each: the limit that theory predicts beside the limit that was measured."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from engines.process.isolation import EngineStepper
from experiments.limits.engine_limit import PRECISION, measure_engine
from experiments.limits.perturbed import rest_of_scheme
from experiments.runs.progress import Progress
from experiments.runs.runner import current
from reference.identification import Identification, candidates_for, identify_run
from reference.limit import Limit
from reference.outcome import Outcome
from reference.stepper import SchemeStepper, Stepper, stepper_named
from reference.system import MassSpringSystem
from reference.theory.equilibria import Equilibrium, spring_equilibrium
from reference.theory.limits import stability_limit
from reference.theory.measured_mode import measured_mode_limit
from reference.theory.rates import Rates, rates

#: An engine is identified from this many steps, at a tenth of what the fastest mode allows.
IDENTIFYING_STEPS = 200


@dataclass(frozen=True)
class Row:
    """One stepper on one system.

    Attributes:
        predicted: its limit by theory, with the reason where there is none.
        measured: the same from runs; an engine's with the growth factors of its own step just below and above it.
        outcome: how the measurement ended.
    """

    stepper: str
    kind: str
    system: MassSpringSystem
    predicted: Limit
    measured: Limit
    outcome: str = "done"

    @property
    def relative_difference(self) -> float | None:
        """(measured - predicted) / predicted; None without either, or where one is known between two values only."""
        if self.predicted.dt is None or self.measured.dt is None or not (self.predicted.exact and self.measured.exact):
            return None
        return (self.measured.dt - self.predicted.dt) / self.predicted.dt

    @property
    def document(self) -> dict[str, Any]:
        """The row as the command line's JSON has it."""
        reasons = {"predicted": self.predicted.remark, "measured": self.measured.remark}
        if self.predicted.remark == self.measured.remark:
            reasons = {"predicted and measured": self.predicted.remark}
        return {
            "stepper": self.stepper,
            "damping": float(self.system.damping.max()),
            "drag": self.system.drag,
            "predicted_dt_s": self.predicted.dt,
            "predicted_certainty": self.predicted.certainty if self.predicted.dt is not None else None,
            "predicted_at_most_s": self.predicted.at_most,
            "measured_dt_s": self.measured.dt,
            "relative_difference": self.relative_difference,
            "outcome": self.outcome,
            "windows_s": [[low, high] for low, high in self.predicted.windows],
            "reason": "; ".join(f"{word}: {reason}" for word, reason in reasons.items() if reason),
        }


def stability_rows(system: MassSpringSystem, steppers: Sequence[Stepper], progress: Progress) -> list[Row]:
    """Predicted and measured limits of schemes and engines on one system, about its equilibrium.

    What an engine's limit should be is predicted from the scheme it is identified with, on this very system. Engines
    are measured in parallel, in processes of their own, while schemes are worked on here.

    Raises:
        SolverError: if the system has no equilibrium.
    """
    rest = spring_equilibrium(system)
    found = rates(rest)
    dt = 1 / (found.fastest or 1.0)
    engines = [stepper for stepper in steppers if isinstance(stepper, EngineStepper)]
    rows = []
    identified = _identified(engines, system, 0.1 * dt)
    known = {engine.name: _named(identified[engine.name]) for engine in engines}
    limits = _Limits(system, rest, found)
    predicted = {name: _predicted(identified[name], scheme, limits) for name, scheme in known.items()}
    with current().threads() as pool:
        measured = {
            e.name: pool.submit(measure_engine, e, system, rest, dt, PRECISION, known[e.name], predicted[e.name], found)
            for e in engines
        }
        for stepper in steppers:
            progress(stepper.name)
            if isinstance(stepper, SchemeStepper):
                rows.append(_scheme_row(stepper, limits))
            elif isinstance(stepper, EngineStepper):
                rows.append(_engine_row(stepper, system, predicted[stepper.name], measured[stepper.name].result()))
            else:
                none = Limit(None, "stability is of schemes and engines; identify says which scheme this is")
                rows.append(Row(stepper.name, stepper.kind, system, none, none, "unsupported"))
    return rows


def _identified(engines: Sequence[EngineStepper], system: MassSpringSystem, dt: float) -> Mapping[str, Identification]:
    """Which scheme each engine is, from a run on the system with a dt [s]."""
    runs = [(engine, engine.run(system, dt, IDENTIFYING_STEPS)) for engine in engines]
    known = candidates_for(runs, system, dt, IDENTIFYING_STEPS) if engines else {}
    return {engine.name: identify_run(engine.name, run, system, known) for engine, run in runs}


def _named(identification: Identification) -> SchemeStepper | None:
    """The scheme that an engine was identified with."""
    return None if identification.identified_as is None else stepper_named(identification.identified_as)


class _Limits:
    """The predicted limits of schemes on one system, each looked for once.

    Args:
        rest: of the springs.
        found: the eigenvalues of the motion there.
    """

    def __init__(self, system: MassSpringSystem, rest: Equilibrium, found: Rates) -> None:
        self.system, self._rest, self._found = system, rest, found
        self._known: dict[str, Limit] = {}

    def about(self, stepper: SchemeStepper) -> tuple[Equilibrium, Rates] | Limit:
        """Where a scheme's system is at rest, and how it moves there; where there is no rest, no limit and why."""
        rest = rest_of_scheme(stepper, self.system, self._rest)
        if isinstance(rest, Limit):
            return rest
        return rest, rates(rest) if stepper.on_rods else self._found

    def of(self, stepper: SchemeStepper) -> Limit:
        """A scheme's."""
        if stepper.name not in self._known:
            about = self.about(stepper)
            limit = about if isinstance(about, Limit) else stability_limit(stepper.scheme, *about)
            self._known[stepper.name] = limit
        return self._known[stepper.name]


def _predicted(identification: Identification, scheme: SchemeStepper | None, limits: _Limits) -> Limit:
    """The limit of the scheme an engine was identified with."""
    if scheme is None:
        return Limit(None, identification.reason or str(identification).partition(": ")[2])
    return limits.of(scheme)


def _scheme_row(stepper: SchemeStepper, limits: _Limits) -> Row:
    about, predicted = limits.about(stepper), limits.of(stepper)
    if isinstance(about, Limit):
        return Row(stepper.name, stepper.kind, limits.system, about, about)
    measured = measured_mode_limit(stepper.scheme, about[0], predicted, about[1])
    return Row(stepper.name, stepper.kind, limits.system, predicted, measured)


def _engine_row(stepper: EngineStepper, system: MassSpringSystem, predicted: Limit, measured: Limit | Outcome) -> Row:
    if isinstance(measured, Outcome):
        reason = Limit(None, measured.reason)
        return Row(stepper.name, stepper.kind, system, predicted, reason, measured.ending)
    return Row(stepper.name, stepper.kind, system, predicted, measured)
