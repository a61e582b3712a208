"""Steppers on one system, a row for each: the limit that theory predicts beside the limit that was measured."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, replace
from typing import Any

from engines.process.isolation import EngineStepper
from experiments.limits.engine_limit import measure_engine
from experiments.limits.predictions import Predictions, limits_of_engines_elsewhere, named
from experiments.runs.progress import Progress
from experiments.runs.runner import current
from reference.derivation.seen import slopes_of
from reference.errors import SolverError
from reference.limit import Limit
from reference.outcome import Outcome
from reference.stepper import SchemeStepper, Stepper
from reference.system import MassSpringSystem
from reference.theory.equilibria import equilibrium_on_obstacles, spring_equilibrium
from reference.theory.measured_mode import measured_mode_limit

#: What is said of one that adapts its steps.
ADAPTS = (
    "it adapts its steps itself, by a tolerance: in a dt it makes as many as it needs, so that this is no limit of a "
    "rule, and its error is that tolerance's"
)


@dataclass(frozen=True)
class Row:
    """One stepper on one system.

    Attributes:
        predicted: its limit by theory, with the reason where there is none.
        measured: the same from runs; an engine's with the growth factors of its own step just below and above it.
        outcome: how the measurement ended.
        about: which rest these are of, where the system has obstacles.
        caveat: what is to be known of the stepper beside its limits.
    """

    stepper: str
    kind: str
    system: MassSpringSystem
    predicted: Limit
    measured: Limit
    outcome: str = "done"
    about: str = ""
    caveat: str = ""

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
        told += [words for words in (self.about, self.caveat) if words]
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
            "predicted_stable_steps": self.predicted.stable_steps,
            "measured_stable_steps": self.measured.stable_steps,
            "windows_s": [[low, high] for low, high in self.predicted.windows],
        }


def stability_rows(system: MassSpringSystem, steppers: Sequence[Stepper], progress: Progress) -> list[Row]:
    """The rows of one system: see `stability_rows_of`."""
    return stability_rows_of([system], steppers, [progress])


def stability_rows_of(
    systems: Sequence[MassSpringSystem], steppers: Sequence[Stepper], progress: Sequence[Progress]
) -> list[Row]:
    """Predicted and measured limits of schemes and engines on systems, about their equilibria, system by system.

    Of a system with obstacles those of schemes are about its rest on them, where that is found; those of engines, whose
    contacts are their own, of its springs and masses alone. The rows say which.

    What an engine's limit should be is predicted from the scheme it is identified with, on this very system. Engines
    are at work in processes of their own, with the next systems too, while schemes are worked on here.

    Args:
        progress: told of each system's steppers.

    Raises:
        SolverError: if a system has no equilibrium.
    """
    caveats = {stepper.name: _caveat(stepper) for stepper in steppers}
    with current().threads(1) as theory, current().threads() as pool:
        begun = [_AtWork(system, steppers, pool, theory) for system in systems]
        of_schemes = [at_work.rows_of_schemes(tell) for at_work, tell in zip(begun, progress, strict=True)]
        found = [row for at_work, rows in zip(begun, of_schemes, strict=True) for row in at_work.all_rows(rows)]
        return [replace(row, caveat=caveats[row.stepper]) for row in found]


def _caveat(stepper: Stepper) -> str:
    """Of a user's own stepper that makes more steps of its own, or fewer, by what forces are."""
    if stepper.kind != "own" or not slopes_of(stepper, []).adapts:
        return ""
    return ADAPTS


class _AtWork:
    """One system, whose engines are at work in the threads of a pool; what they are is found in a thread of its own."""

    def __init__(
        self,
        system: MassSpringSystem,
        steppers: Sequence[Stepper],
        pool: ThreadPoolExecutor,
        theory: ThreadPoolExecutor,
    ) -> None:
        self._system, self._steppers, self._pool = system, steppers, pool
        alone = replace(system, obstacles=())
        self._alone = Predictions(alone, spring_equilibrium(alone))
        engines = [stepper for stepper in steppers if isinstance(stepper, EngineStepper)]
        running = [(engine, pool.submit(self._alone.identifying_run, engine)) for engine in engines]
        self._measuring = theory.submit(self._begin_to_measure, running)

    def rows_of_schemes(self, progress: Progress) -> dict[str, Row]:
        """By name."""
        on_obstacles, about = self._alone, ""
        if self._system.obstacles:
            rest, about = equilibrium_on_obstacles(self._system)
            on_obstacles = Predictions(self._system, rest)
        rows = {}
        for stepper in self._steppers:
            progress(stepper.name)
            if isinstance(stepper, SchemeStepper):
                rows[stepper.name] = _scheme_row_about(stepper, self._system, on_obstacles, self._alone, about)
        return rows

    def all_rows(self, of_schemes: Mapping[str, Row]) -> Iterator[Row]:
        """In the steppers' order, once all engines are measured."""
        measuring = self._measuring.result()
        for stepper in self._steppers:
            if stepper.name in of_schemes:
                yield of_schemes[stepper.name]
            elif stepper.name in measuring:
                predicted, measured = measuring[stepper.name]
                row = _engine_row(stepper, self._system, predicted, measured.result())
                yield replace(row, about="of the scene without its obstacles" if self._system.obstacles else "")
            else:
                none = Limit(None, "stability is of schemes and engines; identify says which scheme this is")
                yield Row(stepper.name, stepper.kind, self._system, none, none, "unsupported")

    def _begin_to_measure(
        self, running: Sequence[tuple[EngineStepper, Future[Outcome]]]
    ) -> dict[str, tuple[Limit, Future[Limit | Outcome]]]:
        """What is predicted of each engine, by name, and its measurement, which is at work."""
        all_runs = [(engine, run.result()) for engine, run in running]
        measuring: dict[str, tuple[Limit, Future[Limit | Outcome]]] = {}
        for engine, run in all_runs:
            if run.ending == "timed out":  # what takes too long for a few short steps is not asked for thousands
                measured: Future[Limit | Outcome] = Future()
                measured.set_result(run)
                measuring[engine.name] = Limit(None, f"not identified; {run.reason}"), measured
        runs = [(engine, run) for engine, run in all_runs if engine.name not in measuring]
        found = limits_of_engines_elsewhere(self._alone.system, runs)
        for (engine, _), (scheme, predicted) in zip(runs, found, strict=True):
            measured = self._pool.submit(measure_engine, engine, self._alone, named(scheme), predicted)
            measuring[engine.name] = predicted, measured
        return measuring


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


def _engine_row(stepper: Stepper, system: MassSpringSystem, predicted: Limit, measured: Limit | Outcome) -> Row:
    if isinstance(measured, Outcome):
        reason = Limit(None, measured.reason)
        return Row(stepper.name, stepper.kind, system, predicted, reason, measured.ending)
    return Row(stepper.name, stepper.kind, system, predicted, measured)
