"""A still of every scene at its end, its springs coloured by strain."""

from __future__ import annotations

from math import ceil
from typing import Any

import numpy as np

from experiments.experiment import Result
from experiments.scenes import SHOWN_BY
from reference.state import Trajectory
from reference.system import MassSpringSystem
from report.figures import TITLE, Picture, new_figure
from report.film.drawing import Drawing, add_length, add_strain_bar, strain
from report.film.film import look_at

#: Scenes in a row.
COLUMNS = 3


def draw(result: Result) -> Picture:
    """One panel for each scene, each with a scale of its own."""
    motions = result.data["motions"]
    rows = max(1, ceil(len(motions) / COLUMNS))
    figure, axes = new_figure(figsize=(11, 3.3 * rows), nrows=rows, ncols=COLUMNS, squeeze=False)
    places = axes.ravel().tolist()
    for place, (name, (system, motion)) in zip(places, motions.items(), strict=False):
        still(figure, place, system, motion)
        place.set_title(
            f"{name}, {motion.times[-1]:g} s, dt {result.data['dts'][name]:g} s", loc="left", fontsize=TITLE
        )
    for place in places[len(motions) :]:
        place.set_visible(False)
    return Picture(figure, _alt(motions))


def animate(result: Result) -> str:
    """Some of the scenes as they move."""
    from report.film.animations import SHOWN, animated

    motions = result.data["motions"]
    return "".join(animated(name, *motions[name]).html() for name in SHOWN if name in motions)


def still(figure: Any, axes: Any, system: MassSpringSystem, motion: Trajectory) -> None:
    """The end of a motion on axes, with the scale of strain at their right."""
    from matplotlib.axes import Axes

    look = look_at(system, [motion])
    Drawing(axes, system, look).show(motion.positions[-1], system)
    add_length(axes, look.window)
    beside: Axes = axes.inset_axes((1.03, 0.05, 0.03, 0.8))
    add_strain_bar(figure, beside, look.most, "strain [%]")


def _alt(motions: dict[str, tuple[MassSpringSystem, Trajectory]]) -> str:
    parts = []
    for name, (system, motion) in motions.items():
        found = 100 * strain(system, motion.positions[-1])
        parts.append(
            f"{name}, {len(system.masses)} masses after {motion.times[-1]:g} s, strain {np.min(found):.2g} to "
            f"{np.max(found):.2g} %"
        )
    return f"Every scene at its end by {SHOWN_BY}, springs coloured by strain: " + "; ".join(parts) + "."
