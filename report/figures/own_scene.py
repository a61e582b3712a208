"""A user's own scene at its end, its springs coloured by strain."""

from __future__ import annotations

import numpy as np

from experiments.experiment import Result
from reference.line import in_plane
from report.figures import Picture, new_figure
from report.figures.scenes import still
from report.film.drawing import strain

#: An animation of more springs would be a page for itself.
MOST = 2000


def animate(result: Result) -> str:
    """The scene as it moves, where it does and is not too large for a page."""
    from report.film.animations import animated

    system, motion = result.data["system"], result.data["motion"]
    if len(motion) < 2 or not 0 < len(system.springs) <= MOST:
        return ""
    return animated("the scene", system, motion).html()


def draw(result: Result) -> Picture:
    """One still with its scales."""
    system, motion = result.data["system"], result.data["motion"]
    figure, axes = new_figure(figsize=(7.0, 4.2))
    if not len(system.springs):
        axes.plot(*in_plane(motion.positions[-1])[:, :2].T, "o", color="#333333")
        axes.set_aspect("equal")
        axes.set_xlabel("x [m]")
        axes.set_ylabel("y [m]")
        return Picture(figure, f"{len(system.masses)} masses without springs after {motion.times[-1]:g} s.")
    still(figure, axes, system, motion)
    found = 100 * strain(system, motion.positions[-1])
    alt = (
        f"{len(system.masses)} masses after {motion.times[-1]:g} s, springs coloured by strain from "
        f"{np.min(found):.2g} to {np.max(found):.2g} %."
    )
    return Picture(figure, alt)
