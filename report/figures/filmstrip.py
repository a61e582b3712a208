"""Strings at several times, side by side on one pair of axes: a row of a film."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from reference.state import Trajectory


@dataclass(frozen=True)
class Strip:
    """One motion in a row, drawn in a style of matplotlib's."""

    motion: Trajectory
    style: dict[str, Any]


def draw_row(axes: Any, strips: Sequence[Strip], times: Sequence[float], frame: tuple[float, float, float]) -> None:
    """Draw motions over one another at some times [s], one frame beside the other.

    Args:
        frame: how far a frame reaches to either side, below and above the anchor [m]; what leaves it is cut off.
    """
    from matplotlib.patches import Rectangle

    side, below, above = frame
    for i, time in enumerate(times):
        middle = 2 * side * i
        window = Rectangle((middle - side, -below), 2 * side, below + above, transform=axes.transData)
        for strip in strips:
            positions = _at(strip.motion, time)
            if positions is not None:
                (drawn,) = axes.plot(middle + positions[:, 0], positions[:, 1], **strip.style)
                drawn.set_clip_path(window)  # afterwards: whoever is plotted is clipped by the axes
        axes.plot(middle, 0, marker="v", color="#333333")
        if i:
            axes.axvline(middle - side, color="#cccccc", linewidth=0.8)
    axes.set_xlim(-side, 2 * side * len(times) - side)
    axes.set_ylim(-below, above)
    axes.set_aspect("equal")
    axes.set_xticks([2 * side * i for i in range(len(times))], [f"{time:g} s" for time in times])
    axes.set_yticks([])
    axes.grid(visible=False)


def _at(motion: Trajectory, time: float) -> Any:
    """Positions at the time nearest [m]; None if the motion has ended by then."""
    if time > motion.times[-1] + 1e-9:
        return None
    return motion.positions[int(np.abs(motion.times - time).argmin())]
