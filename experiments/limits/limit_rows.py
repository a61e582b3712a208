"""Steppers on one system, a row for each: the limit that theory predicts beside the limit that was measured."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from engines.process.isolation import EngineStepper
from experiments.limits.engine_limit import measure_engine
from experiments.limits.predictions import Predictions, named
from experiments.runs.progress import Progress
from experiments.runs.runner import current
from reference.errors import SolverError
from reference.limit import Limit
from reference.outcome import Outcome
from reference.stepper import SchemeStepper, Stepper
from reference.system import MassSpringSystem
from reference.theory.equilibria import equilibrium_on_obstacles, spring_equilibrium
from reference.theory.measured_mode import measured_mode_limit


@dataclass(frozen=True)
class Row:
    """One stepper on one system.

    Attributes:
        predicted: its limit by theory, with the reason where there is none.
        measured: the same from runs; an engine's with the growth factors of its own step just below and above it.
        outcome: how the measurement ended.
        about: which rest these are of, where the system has obstacles.
    """

    stepper: str
    kind: str
    system: MassSpringSystem
    predicted: Limit
    measured: Limit
    outcome: str = "done"
    about: str = ""

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
        told = [f"{word}: {reason}" for word, reason in reasons.items() if reason]
        if self.about:
            told.append(self.about)
        return {
            "stepper": self.stepper,
            "damping": float(self.system.damping.max(initial=0.0)),
            "drag": self.system.drag,
            "predicted_dt_s": self.predicted.dt,
            "measured_dt_s": self.measured.dt,
            "relative_difference": self.relative_difference,
            "outcome": self.outcome,
            "reason": "; ".join(told),
            "predicted_certainty": self.predicted.certainty if self.predicted.dt is not None else None,
            "predicted_at_most_s": self.predicted.at_most,
            "windows_s": [[low, high] for low, high in self.predicted.windows],
        }


def stability_rows(system: MassSpringSystem, steppers: Sequence[Stepper], progress: Progress) -> list[Row]:
    """Predicted and measured limits of schemes and engines on one system, about its equilibrium.

    Of a system with obstacles those of schemes are about its rest on them, where that is found; those of engines, whose
    contacts are their own, of its springs and masses alone. The rows say which.

    What an engine's limit should be is predicted from the scheme it is identified with, on this very system. Engines
    are measured in parallel, in processes of their own, while schemes are worked on here.

    Raises:
        SolverError: if the system has no equilibrium.
    """
    alone = replace(system, obstacles=())
    predictions = Predictions(alone, spring_equilibrium(alone))
    of_schemes, about = predictions, ""
    if system.obstacles:
        rest, about = equilibrium_on_obstacles(system)
        of_schemes = Predictions(system, rest)
    engines = [stepper for stepper in steppers if isinstance(stepper, EngineStepper)]
    identified = predictions.identified(engines)
    predicted = {name: predictions.of_engine(found) for name, found in identified.items()}
    rows = []
    with current().threads() as pool:
        measured = {
            e.name: pool.submit(measure_engine, e, predictions, named(identified[e.name]), predicted[e.name])
            for e in engines
        }
        for stepper in steppers:
            progress(stepper.name)
            if isinstance(stepper, SchemeStepper):
                rows.append(_scheme_row_about(stepper, system, of_schemes, predictions, about))
            elif isinstance(stepper, EngineStepper):
                row = _engine_row(stepper, system, predicted[stepper.name], measured[stepper.name].result())
                rows.append(replace(row, about="of the scene without its obstacles" if system.obstacles else ""))
            else:
                none = Limit(None, "stability is of schemes and engines; identify says which scheme this is")
                rows.append(Row(stepper.name, stepper.kind, system, none, none, "unsupported"))
    return rows


def _scheme_row_about(
    stepper: SchemeStepper, system: MassSpringSystem, on_obstacles: Predictions, alone: Predictions, about: str
) -> Row:
    """About the rest on obstacles, if there is one and the scheme's limit is found there; else without them."""
    try:
        return replace(_scheme_row(stepper, system, on_obstacles), about=about)
    except SolverError as error:
        why = f"of the scene without its obstacles: {error}"
        return replace(_scheme_row(stepper, system, alone), about=why)


def _scheme_row(stepper: SchemeStepper, system: MassSpringSystem, predictions: Predictions) -> Row:
    about, predicted = predictions.about(stepper), predictions.of(stepper)
    if isinstance(about, Limit):
        return Row(stepper.name, stepper.kind, system, about, about)
    measured = measured_mode_limit(stepper.scheme, about[0], predicted, about[1])
    return Row(stepper.name, stepper.kind, system, predicted, measured)


def _engine_row(stepper: EngineStepper, system: MassSpringSystem, predicted: Limit, measured: Limit | Outcome) -> Row:
    if isinstance(measured, Outcome):
        reason = Limit(None, measured.reason)
        return Row(stepper.name, stepper.kind, system, predicted, reason, measured.ending)
    return Row(stepper.name, stepper.kind, system, predicted, measured)
