"""How far does each engine go from the true motion of a string, and why?"""

from __future__ import annotations

from collections.abc import Sequence

from experiments.experiment import Experiment, Result, Table
from experiments.runs.comparison import Comparison, Run, compare, finite, remarks
from experiments.runs.progress import Progress
from experiments.runs.steppers import default_steppers
from reference.scenes import Setup, find
from reference.state import Array
from reference.stepper import stepper_named


def setup() -> Setup:
    """The default string: ten masses let go horizontally."""
    string = find("string")
    return string.setup({})


def run(progress: Progress) -> Result:
    """Every stepper on the string, against the true motion and against the scheme it is identified with."""
    return result_of(compare(setup(), default_steppers(), progress))


def result_of(comparison: Comparison) -> Result:
    """A comparison as findings and tables."""
    tables = [_summary(comparison), _over_time(comparison)]
    return Result(_findings(comparison), tables, {"comparison": comparison}, _failures(comparison))


def _findings(comparison: Comparison) -> list[str]:
    engines = [r for r in comparison.runs if r.stepper.kind == "engine" and r.outcome.ending == "done"]
    named = [r for r in engines if r.identification.identified_as]
    if not named:
        return ["No engine ran that could be identified."]
    on_springs = [r for r in named if not stepper_named(str(r.identification.identified_as)).on_rods] or named
    furthest = max(on_springs, key=_error)
    worst = max((r.identification.error for r in named if not r.identification.by_single_steps), default=0.0)
    sentences = [
        f"{len(named)} of {len(engines)} engine settings are identified: each follows a scheme of the catalogue to "
        f"{worst:.1e} m or better, though {furthest.stepper.name} is up to {_error(furthest):.1e} m from the true "
        "motion.",
        "What separates an engine from the true motion is its scheme at this dt: rounding, and what else an engine "
        f"might do, comes to {worst:.1e} m at most.",
    ]
    sentences += _of_first_order(comparison, named)
    strangers = [f"{r.stepper.name} ({r.identification.reason})" for r in engines if not r.identification.identified_as]
    if strangers:
        sentences.append(f"Not identified: {', '.join(strangers)}.")
    return sentences + remarks(engines)


def _of_first_order(comparison: Comparison, named: Sequence[Run]) -> list[str]:
    """Why Euler looks as good as kick-drift, where it does: where engines of both are as near to the true motion."""
    errors = {run.identification.identified_as: _error(run) for run in named}
    if not {"euler", "kick_drift"} <= errors.keys() or not 0.5 < errors["euler"] / errors["kick_drift"] < 2:
        return []
    return [
        f"In {comparison.times[-1]:g} s euler comes as near to the true motion as kick_drift, {errors['euler']:.1e} "
        f"and {errors['kick_drift']:.1e} m: both are of first order. They part later: euler's energy grows with every "
        "step, kick_drift's stays within bounds, as the experiment `energy` shows."
    ]


def _error(run: Run) -> float:
    return float(run.error.max()) if run.error is not None else 0.0


def _summary(comparison: Comparison) -> Table:
    columns = ["stepper", "kind", "version", "outcome", "error [m]", "identified as", "deviation [m]"]
    keys = ["stepper", "kind", "version", "outcome", "error_m", "identified_as", "identification_error_m"]
    rows = [[*(run.row[key] for key in keys), ", ".join(run.identification.ties), run.why] for run in comparison.runs]
    return Table("divergence", [*columns, "ties with", "reason"], rows)


def _over_time(comparison: Comparison) -> Table:
    """One row per time and run: what the figure draws."""
    rows = []
    for run in comparison.runs:
        for i, time in enumerate(comparison.times.tolist()):
            error, deviation = (_at(distances, i) for distances in (run.error, run.deviation))
            rows.append([run.stepper.name, time, error, deviation])
    return Table("divergence_over_time", ["stepper", "time [s]", "error [m]", "deviation [m]"], rows)


def _at(distances: Array | None, i: int) -> float | None:
    """The i-th distance [m]; None where there is none, as after a run has blown up."""
    return None if distances is None or i >= len(distances) else finite(float(distances[i]))


def _failures(comparison: Comparison) -> list[str]:
    return [
        f"{run.stepper.name}: {run.outcome.ending}, {run.outcome.reason}"
        for run in comparison.runs
        if run.outcome.ending != "done"
    ]


EXPERIMENT = Experiment(
    name="divergence",
    title="Divergence, and why",
    question="How far does each stepper go from the true motion of a string, and which scheme explains it?",
    slides="3-11, 13",
    run=run,
)
