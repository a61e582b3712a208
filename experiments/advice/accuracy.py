"""With which dt would an engine end within a part of the scene's size of the true motion? Predicted from its order.

The error of a scheme of order p falls as dt^p: from the error that was measured at one dt follows the dt for another
error. That holds where the motion is not chaotic and dt well below the limit of stability, which bounds it besides.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from experiments.advice.advice import ADVISED, Advice, rounded_down
from experiments.experiment import Table
from experiments.runs.comparison import Comparison
from reference.stepper import stepper_named

#: The error that is asked for, as a part of the scene's size.
PART = 0.01


@dataclass(frozen=True)
class Accurate:
    """Of one engine.

    Attributes:
        error: the largest distance from the true motion at the compared dt, as a part of the size, measured.
        order: of the scheme it is identified with.
        dt: for an error of PART [s], predicted.
        bound: whether it is the stability limit that bounds it.
    """

    engine: str
    error: float
    order: int
    dt: float
    bound: bool


def accurate_steps(compared: Comparison, advice: Sequence[Advice]) -> list[Accurate]:
    """Of all engines whose error is known and whose scheme steps the scene's own springs."""
    known: Mapping[str, Advice] = {one.engine: one for one in advice}
    size, dt = compared.setup.system.size or 1.0, compared.setup.dt
    found = []
    for run in compared.runs:
        named, error = run.identification.identified_as, run.largest_error
        if not error or named is None or stepper_named(named).on_rods:
            continue
        order = stepper_named(named).scheme.order
        wanted = dt * (PART * size / error) ** (1 / order)
        safe = known[run.stepper.name].safe if run.stepper.name in known else None
        most = ADVISED * safe if safe else wanted
        step = rounded_down(min(wanted, most))
        found.append(Accurate(run.stepper.name, error / size, order, step, most < wanted))
    return found


def sentences(found: Sequence[Accurate], dt: float) -> list[str]:
    """The shortest and the longest of these steps."""
    if not found:
        return []
    least, most = min(found, key=lambda one: one.dt), max(found, key=lambda one: one.dt)
    said = (
        f"To stay within {PART:.0%} of the scene's size of the true motion, by the order of its scheme from its error"
    )
    bound = ", where its stability bounds it" if most.bound else ""
    return [f"{said} at dt = {dt:g} s: {least.engine} needs dt = {least.dt:g} s, {most.engine} {most.dt:g} s{bound}."]


def table(found: Sequence[Accurate]) -> Table:
    """A row for each."""
    columns = ["engine", "measured error at the compared dt [of the size]", "order", f"predicted dt for {PART:.0%} [s]"]
    rows: list[list[object]] = [
        [one.engine, one.error, one.order, one.dt, "stability" if one.bound else "accuracy"] for one in found
    ]
    return Table("accuracy", [*columns, "bounded by"], rows)
