"""What does a string become as it gets stiffer?"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from engines.engine import find as find_engine
from engines.process.isolation import EngineStepper
from experiments.experiment import Experiment, Result, Table
from experiments.runs.comparison import finite
from experiments.runs.progress import Progress
from experiments.runs.runner import answer
from reference.pendulum import PendulumMotion
from reference.scenes import find
from reference.theory.exact import exact

STIFFNESSES = (2e2, 2e3, 2e4, 2e5, 2e6)
DT, DURATION = 1e-3, 0.5

#: The cable runs with a smaller step, so that its own error (about dt^4) stays far below what is measured.
CABLE_DT = 2.5e-4


def run(progress: Progress) -> Result:
    """The true motion of ever stiffer strings against the pendulum's, and against MuJoCo's cable."""
    steps = round(DURATION / DT)
    progress("pendulum")
    rods = exact(find("string").system({}), DT, steps, equations=PendulumMotion)
    progress("MuJoCo cable")
    every = round(DT / CABLE_DT)
    outcome = EngineStepper(find_engine("mujoco_cable_rk4"), isolate=answer).run(
        find("string").system({}), CABLE_DT, steps * every
    )
    cable = outcome.trajectory.positions[::every] if outcome.ending == "done" and outcome.trajectory else None
    rows: list[list[float | None]] = []
    for stiffness in STIFFNESSES:
        progress(f"string of {stiffness:g} N/m")
        springs = exact(find("string").system({"stiffness": stiffness}), DT, steps)
        to_cable = None if cable is None else float(np.linalg.norm(springs.positions - cable, axis=2).max())
        rows.append([stiffness, float(springs.distance(rods).max()), to_cable])
    own = None if cable is None else float(np.linalg.norm(rods.positions - cable, axis=2).max())
    failures = [] if cable is not None else [f"mujoco_cable_rk4: {outcome.ending}, {outcome.reason}"]
    return result_of(rows, own, failures)


def result_of(rows: list[list[float | None]], cable_error: float | None, failures: Sequence[str] = ()) -> Result:
    """Distances as findings and a table.

    Args:
        rows: stiffness [N/m], distance of the string from the pendulum and from the cable [m]; at least four.
        cable_error: how far the cable is from the pendulum [m]; None where it did not run.
    """
    stiff = np.array([row[:2] for row in rows[2:]], dtype=float)
    stiffness, distance = np.log(stiff.T)
    slope = float(np.polyfit(stiffness, distance, 1)[0])
    columns = ["stiffness [N/m]", "string to pendulum [m]", "string to MuJoCo cable [m]"]
    tables = [Table("stiff_limit", columns, [[finite(v) for v in row] for row in rows])]
    data = {"rows": rows, "slope": slope, "cable_error": cable_error}
    return Result(_findings(slope, rows, cable_error), tables, data, failures)


def _findings(slope: float, rows: list[list[float | None]], cable_error: float | None) -> list[str]:
    first, last = rows[0], rows[-1]
    sentences = [
        f"From {first[0]:g} to {last[0]:g} N/m the string comes from {first[1]:.2g} m to {last[1]:.2g} m of the "
        f"pendulum of as many masses, at most on the way. From {rows[2][0]:g} N/m on the distance goes as stiffness to "
        f"the power {slope:.2f}, fitted (predicted: -1)."
    ]
    if cable_error is not None:
        sentences.append(
            f"MuJoCo's composite cable, its masses lumped at the tips, is {cable_error:.1e} m at most from that "
            f"pendulum, with RK4 at dt = {CABLE_DT:g} s."
        )
    return sentences


EXPERIMENT = Experiment(
    name="stiff_limit",
    title="The stiff limit",
    question="What does a string become as its springs get stiffer, and is that what MuJoCo's cable is?",
    slides="3-5, 27",
    run=run,
)
