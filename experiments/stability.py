"""Up to which dt is each stepper stable, predicted and measured?"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

from experiments.experiment import Experiment, Result, Table
from experiments.limits.limit_rows import Row, stability_rows_of
from experiments.runs.progress import Progress
from experiments.runs.steppers import steppers_here
from reference.scenes import find

#: The cases of spring damping [N s/m] and drag [N s/m] that the report shows.
CASES: tuple[Mapping[str, float], ...] = ({}, {"damping": 0.1}, {"damping": 0.5}, {"drag": 0.1})


def run(progress: Progress) -> Result:
    """The limits of schemes and engines on the string, in every case.

    Engines' own schemes are left out: their limits are what the engines' are predicted to be.
    """
    steppers = [s for s in steppers_here().values() if s.kind in ("scheme", "in_place", "engine")]
    systems = [find("string").system(case) for case in CASES]
    return result_of(stability_rows_of(systems, steppers, [partial(_tell, progress, _label(case)) for case in CASES]))


def _label(case: Mapping[str, float]) -> str:
    return ", ".join(f"{name} {value:g}" for name, value in case.items()) or "undamped"


def _tell(progress: Progress, case: str, what: str) -> None:
    progress(f"{case}, {what}")


def result_of(rows: Sequence[Row]) -> Result:
    """Rows as findings and a table."""
    columns = ["stepper", "damping [N s/m]", "drag [N s/m]", "predicted dt [s]", "how sure", "measured dt [s]"]
    columns += ["relative difference", "outcome", "reason"]
    columns += ["engine's own growth factor at 0.99 of it", "at 1.01"]
    table = Table("stability", columns, [_cells(row) for row in rows])
    return Result(_findings(rows), [table], {"rows": rows}, _failures(rows))


def _cells(row: Row) -> list[object]:
    told = row.document
    limits = [told["predicted_dt_s"], told["predicted_certainty"], told["measured_dt_s"], told["relative_difference"]]
    return [row.stepper, told["damping"], told["drag"], *limits, row.outcome, told["reason"], *_factors(row)]


def _factors(row: Row) -> tuple[float | None, float | None]:
    """The growth factors of an engine's step below and above its measured limit."""
    return row.measured.factors or (None, None)


def _failures(rows: Sequence[Row]) -> list[str]:
    """What was not done, and why; the same in several cases is said once."""
    documents = [row.document for row in rows]
    undone = [f"{d['stepper']}: {d['outcome']}, {d['reason']}" for d in documents if d["outcome"] != "done"]
    return list(dict.fromkeys(undone))


def _findings(rows: Sequence[Row]) -> list[str]:
    compared = [row for row in rows if row.relative_difference is not None]
    if not compared:
        return ["No stepper has a limit here that could be both predicted and measured."]
    worst = max(compared, key=lambda row: abs(row.relative_difference or 0.0))
    apart = abs(worst.relative_difference or 0.0)
    sentences = [
        f"{len(compared)} limits were predicted and measured: they differ by {100 * apart:.1g} % at most (the widest "
        f"apart is {worst.stepper})."
    ]
    never = sorted({row.stepper for row in rows if row.predicted.growth is not None})
    if never:
        sentences.append(f"Unstable at any dt in at least one of the cases, however small: {', '.join(never)}.")
    return sentences


EXPERIMENT = Experiment(
    name="stability",
    title="Stability limits",
    question="Up to which dt is each stepper stable, predicted and measured?",
    slides="15",
    run=run,
)
