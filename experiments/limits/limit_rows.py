"""Steppers on one system, a row for each: the limit that theory predicts beside the limit that was measured."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from engines.process.isolation import EngineStepper
from experiments.limits.engine_limit import measure_engine
from experiments.limits.perturbed import rest_of_scheme
from experiments.runs.progress import Progress
from experiments.runs.runner import current
from reference.identification import Identification, identify_all
from reference.limit import Limit
from reference.outcome import Outcome
from reference.stepper import SchemeStepper, Stepper, stepper_named
from reference.system import MassSpringSystem
from reference.theory.equilibria import Equilibrium, equilibrium_of, spring_equilibrium
from reference.theory.limits import fastest_rate, stability_limit
from reference.theory.measured_mode import measured_mode_limit

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
        """(measured - predicted) / predicted; None without either."""
        if self.predicted.dt is None or self.measured.dt is None:
            return None
        return (self.measured.dt - self.predicted.dt) / self.predicted.dt

    @property
    def document(self) -> dict[str, Any]:
        """The row as the command line's JSON has it."""
        reasons = {"predicted": self.predicted.reason, "measured": self.measured.reason}
        if self.predicted.reason == self.measured.reason:
            reasons = {"predicted and measured": self.predicted.reason}
        return {
            "stepper": self.stepper,
            "damping": float(self.system.damping.max()),
            "drag": self.system.drag,
            "predicted_dt_s": self.predicted.dt,
            "measured_dt_s": self.measured.dt,
            "relative_difference": self.relative_difference,
            "outcome": self.outcome,
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
    dt = 1 / fastest_rate(rest)
    engines = [stepper for stepper in steppers if isinstance(stepper, EngineStepper)]
    rows = []
    with current().threads() as pool:
        measured = {engine.name: pool.submit(measure_engine, engine, system, rest, dt) for engine in engines}
        identified = _identified(engines, system, 0.1 * dt)
        for stepper in steppers:
            progress(stepper.name)
            if isinstance(stepper, SchemeStepper):
                rows.append(_scheme_row(stepper, system, rest))
            elif isinstance(stepper, EngineStepper):
                predicted = _predicted(identified[stepper.name], system, rest)
                rows.append(_engine_row(stepper, system, predicted, measured[stepper.name].result()))
            else:
                none = Limit(None, "stability is of schemes and engines; identify says which scheme this is")
                rows.append(Row(stepper.name, stepper.kind, system, none, none, "unsupported"))
    return rows


def _identified(engines: Sequence[EngineStepper], system: MassSpringSystem, dt: float) -> Mapping[str, Identification]:
    """Which scheme each engine is, from a run on the system with a dt [s]."""
    runs = [(engine, engine.run(system, dt, IDENTIFYING_STEPS)) for engine in engines]
    return {found.stepper: found for found in identify_all(runs, system, dt, IDENTIFYING_STEPS).each}


def _predicted(identification: Identification, system: MassSpringSystem, rest: Equilibrium) -> Limit:
    """The limit of the scheme an engine was identified with."""
    if identification.identified_as is None:
        return Limit(None, f"not identified; {identification.reason}")
    scheme = stepper_named(identification.identified_as)
    about = rest_of_scheme(scheme, system, rest)
    return about if isinstance(about, Limit) else stability_limit(scheme.scheme, about)


def _scheme_row(stepper: SchemeStepper, system: MassSpringSystem, rest: Equilibrium) -> Row:
    about = equilibrium_of(stepper.equations, system) if stepper.on_rods else rest
    predicted, measured = stability_limit(stepper.scheme, about), measured_mode_limit(stepper.scheme, about)
    return Row(stepper.name, stepper.kind, system, predicted, measured)


def _engine_row(stepper: EngineStepper, system: MassSpringSystem, predicted: Limit, measured: Limit | Outcome) -> Row:
    if isinstance(measured, Outcome):
        reason = Limit(None, measured.reason)
        return Row(stepper.name, stepper.kind, system, predicted, reason, measured.ending)
    return Row(stepper.name, stepper.kind, system, predicted, measured)
