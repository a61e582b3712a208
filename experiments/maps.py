"""Where in a plane of two parameters do perturbations grow, and is that where theory says?"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import numpy as np

from experiments.experiment import Experiment, Result, Table
from experiments.limits.map_axes import axes_for, system_maker
from experiments.limits.stability_map import StabilityMap, stability_map
from experiments.runs.progress import Progress
from experiments.runs.steppers import all_steppers
from reference.errors import InputError
from reference.state import Array

#: Stepper, masses of the string, second axis beside dt and its range, points along each axis (`stability --map` itself
#: takes more).
MAPS = (
    ("heun", 20, "drag", (0.0, 1.0), 96),
    ("rk4", 20, "damping", (0.0, 1.0), 96),
    ("pymunk_springs", 6, "damping", (0.02, 1.0), 12),
)

#: Growth in a step from which on a point counts as unstable; between its negative and it, as on the border.
SURE = 5e-3


#: In full, maps have this many times the points along each axis.
FINER = 4


def run(progress: Progress, finer: int = 1) -> Result:
    """Every map, with the part of its plane where measured and predicted agree.

    Args:
        finer: how many times the points along each axis.
    """
    maps, failures = [], []
    for name, masses, other, span, resolution in MAPS:
        progress(name)
        system_at, dt = system_maker("string", {"masses": str(masses)})
        x, y = axes_for(("dt", other), {other: span}, system_at({}))
        try:
            maps.append(stability_map(all_steppers()[name], system_at, dt, x, y, progress, finer * resolution))
        except InputError as error:
            failures.append(str(error))
    return result_of(maps, failures)


def result_of(maps: Sequence[StabilityMap], failures: Sequence[str] = ()) -> Result:
    """Maps as findings and a table."""
    rows = [[m.stepper, m.y.name, m.growth.size, m.predicted_by, _beyond(m), agreement(m)] for m in maps]
    columns = ["stepper", "dt and", "runs", "predicted by", "part predicted unstable [1]", "part that agrees [1]"]
    return Result(_findings(maps), [Table("maps", columns, rows)], {"maps": maps}, failures)


def predicted_unstable(found: StabilityMap) -> Array:
    """Which points lie beyond the predicted limit, the one at the next value that it is known at, or between two."""
    limits, values = found.boundary.T
    nearest = limits[np.abs(found.y_values[:, None] - values).argmin(axis=1)]
    with np.errstate(invalid="ignore"):
        between = np.interp(found.y_values, values, limits)
    limit = np.where(np.isfinite(between) & np.isfinite(nearest) & (nearest > 0), between, nearest)
    return np.asarray(found.x_values[None, :] > limit[:, None])


def agreement(found: StabilityMap) -> float | None:
    """The part of the surely measured points, growing or not, that lie on the side of the boundary they should.

    None where nothing is predicted, or nothing is sure.
    """
    if not len(found.boundary):
        return None
    growing = found.growth > SURE
    calm = found.growth < 0.1 * SURE
    sure = (growing | calm) & np.isfinite(np.where(growing, 0.0, found.growth))
    if not sure.any():
        return None
    return float((growing == predicted_unstable(found))[sure].mean())


def _beyond(found: StabilityMap) -> float | None:
    return float(predicted_unstable(found).mean()) if len(found.boundary) else None


def _findings(maps: Sequence[StabilityMap]) -> list[str]:
    sentences = []
    for found in maps:
        part = agreement(found)
        if part is not None:
            sentences.append(
                f"{found.stepper}, dt and {found.y.name}: {found.growth.size} runs were measured. Where it is clear "
                f"whether one grows, {part:.1%} are on the side of {found.predicted_by}'s predicted limit where they "
                "should be."
            )
    return sentences or ["No map could be made."]


EXPERIMENT = Experiment(
    name="maps",
    title="Maps of stability",
    question="Where in a plane of dt and damping do perturbations grow, and is that where theory says?",
    slides="12, 15",
    run=run,
    run_in_full=partial(run, finer=FINER),
)
