"""Many steppers on one system: how far each goes from the true motion, and which scheme each one is."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import compress
from typing import Any

import numpy as np

from experiments.runs.fork import begun
from experiments.runs.progress import Progress
from experiments.runs.room import check_room
from experiments.runs.side_by_side import side_by_side
from reference.changes import Change
from reference.errors import SolverError
from reference.identification import Identification, identify_all
from reference.outcome import Outcome
from reference.scenes import Setup
from reference.state import Array, Trajectory
from reference.stepper import SchemeStepper, Stepper
from reference.system import MassSpringSystem
from reference.theory.exact import WHY_NOT_EXACT, exact

#: Steps of the solver of the true motion besides one for every step of a run: seconds, for a string.
MOST_STEPS = 20_000


@dataclass(frozen=True)
class Run:
    """One stepper on one system.

    Attributes:
        stepper: who stepped.
        outcome: how it ended.
        identification: which scheme it was.
        error: distance from the true motion at each time [m], shape (m,); None without one of the two.
        deviation: distance from the identified scheme at each time [m], shape (m,); None where there is none.
    """

    stepper: Stepper
    outcome: Outcome
    identification: Identification
    error: Array | None
    deviation: Array | None

    @property
    def row(self) -> dict[str, Any]:
        """The run in plain numbers and words, None for what is not a number."""
        return {
            "stepper": self.stepper.name,
            "kind": self.stepper.kind,
            "version": self.stepper.version,
            "outcome": self.outcome.ending,
            "reason": self.outcome.reason,
            "error_m": finite(self.largest_error),
            **told(self.identification),
        }

    @property
    def largest_error(self) -> float | None:
        """The largest distance from the true motion [m]; None where that is not known, or the run has no end."""
        return float(self.error.max()) if self.error is not None and self.outcome.ending == "done" else None

    @property
    def why(self) -> str:
        """What there is to say of how it ended, and where it has no name, why."""
        return why(self.outcome, self.identification)


@dataclass(frozen=True)
class Comparison:
    """All steppers on one system.

    Attributes:
        setup: the system and the times.
        true: its true motion; None where that is not known.
        runs: one for each stepper.
        why_not: what there is to say where it is not known.
    """

    setup: Setup
    true: Trajectory | None
    runs: tuple[Run, ...]
    why_not: str = WHY_NOT_EXACT

    @property
    def times(self) -> Array:
        """Of all steps [s], shape (m,)."""
        return np.array([i * self.setup.dt for i in range(self.setup.steps + 1)])

    @property
    def why_no_true_motion(self) -> str | None:
        """What there is to say where the true motion is not known, and so no run has an error."""
        return self.why_not if self.true is None else None

    @property
    def document(self) -> dict[str, Any]:
        """The comparison as the command line's JSON has it; where the true motion is not known it says why."""
        setup = self.setup
        rows = [run.row for run in self.runs]
        asked = {
            "scene": setup.name,
            "dt_s": setup.dt,
            "duration_s": setup.duration,
            "steps": setup.steps,
            "run_duration_s": setup.run_duration,
        }
        why = {"why_no_true_motion": self.why_no_true_motion} if self.why_no_true_motion else {}
        return {**asked, **why, "runs": rows}


def compare(
    setup: Setup, steppers: Sequence[Stepper], progress: Progress = lambda _: None, patient: bool = True
) -> Comparison:
    """Run steppers on a setup. An engine that fails is a run with that outcome; the others still report.

    Args:
        patient: also run those that take long on that many masses.

    Raises:
        InputError: for a dt or duration that makes no sense; where the trajectories would not fit into the memory.
    """
    steps = setup.steps
    kept = [s for s in steppers if patient or not too_slow(s, setup.system)]
    check_room(kept, setup.system, steps, beside=1)

    def task(stepper: Stepper) -> Outcome:
        left_out = None if patient else too_slow(stepper, setup.system)
        return left_out or stepper.run(setup.system, setup.dt, steps, setup.changes)

    outcomes, true, why_not = _outcomes(setup, steppers, task, progress)
    progress("catalogue of schemes")
    identified = identify_all(outcomes, setup.system, setup.dt, steps, setup.changes)
    runs = []
    for (stepper, outcome), identification in zip(outcomes, identified.each, strict=True):
        named = identification.identified_as
        trajectory = outcome.trajectory
        error = None if trajectory is None or true is None else trajectory.distance(true)
        scheme = identified.known.get(named or "")
        deviation = None if trajectory is None or scheme is None else trajectory.distance(scheme)
        runs.append(Run(stepper, outcome, identification, error, deviation))
    return Comparison(setup, true, tuple(runs), why_not)


def _outcomes(
    setup: Setup, steppers: Sequence[Stepper], task: Callable[[Stepper], Outcome], progress: Progress
) -> tuple[list[tuple[Stepper, Outcome]], Trajectory | None, str]:
    """How each stepper ends, and the true motion: that, and every second scheme, beside the rest."""
    is_beside = [isinstance(stepper, SchemeStepper) and i % 2 == 1 for i, stepper in enumerate(steppers)]

    def beside() -> tuple[tuple[Trajectory | None, str], list[Outcome]]:
        true = true_motion(setup.system, setup.dt, setup.steps, setup.changes)
        return true, [task(stepper) for stepper in compress(steppers, is_beside)]

    here = [stepper for stepper, elsewhere in zip(steppers, is_beside, strict=True) if not elsewhere]
    with begun(beside) as answer:
        ran = iter([outcome for _, outcome in side_by_side(here, task, progress)])
        progress("true motion")
        (true, why_not), others = answer()
    also = iter(others)
    return [(s, next(also if other else ran)) for s, other in zip(steppers, is_beside, strict=True)], true, why_not


def true_motion(
    system: MassSpringSystem, dt: float, steps: int, changes: Sequence[Change]
) -> tuple[Trajectory | None, str]:
    """The true motion; where nothing can follow it, or not within some seconds, None, and why."""
    try:
        return exact(system, dt, steps, changes, most_steps=MOST_STEPS), ""
    except SolverError as error:
        return None, str(error)


def too_slow(stepper: Stepper, system: MassSpringSystem) -> Outcome | None:
    """Why a stepper is left out unless it is asked for by name, or None: it says itself how large a system may be."""
    most, n = getattr(stepper, "interactive_up_to", None), len(system.masses)
    if most is None or n <= most:
        return None
    reason = f"left out: with more than {most} masses it takes long, here are {n}; --stepper {stepper.name} runs it"
    return Outcome("unsupported", reason)


def remarks(runs: Sequence[Run]) -> list[str]:
    """What ties with the schemes that are named, and how schemes were told apart that tie on the system itself."""
    found = [run.identification for run in runs]
    ties = {f"{f.identified_as}: {f.remark[0].lower()}{f.remark[1:]}": None for f in found if f.remark}
    ways: dict[str, list[str]] = {}
    for f in found:
        if f.told_apart_by:
            ways.setdefault(f"Told apart by {f.told_apart_by}", []).append(f.stepper)
        if f.by_single_steps and f.identified_as:
            ways.setdefault(f"Named by {f.compared}, each from a state of its own", []).append(f.stepper)
    whom = {way: "all" if len(names) == len(found) else ", ".join(names) for way, names in ways.items()}
    return [*ties, *(f"{way}: {names}." for way, names in whom.items())]


def why(outcome: Outcome, found: Identification) -> str:
    """How a run ended, where not as it should, and why it has no name, where it has none."""
    no_name = f"not identified; {found.reason}" if found.reason and found.reason != outcome.reason else ""
    return "; ".join(words for words in (outcome.reason, no_name) if words)


def told(found: Identification) -> dict[str, Any]:
    """An identification in plain numbers and words: what ties with the scheme that is named, or why none is."""
    return {
        "identified_as": found.identified_as,
        "identification_error_m": finite(found.error),
        "ties": list(found.ties),
        "told_apart_by": found.told_apart_by,
        "compared_by": found.compared if found.ranking else "",
        "why_not_identified": found.reason,
    }


def finite(value: float | None) -> float | None:
    """The number, or None where it is not finite: JSON has no infinity."""
    return value if value is not None and math.isfinite(value) else None
