"""Labels beside the lines they name, moved apart so that all can be read."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from reference.state import Array


@dataclass(frozen=True)
class End:
    """Where a line ends, in the axes' data, and what is to be said of it there."""

    x: float
    y: float
    text: str
    color: str


def label_ends(axes: Any, ends: Sequence[End], gap: float, fontsize: float = 9) -> None:
    """Write the texts to the right of the axes, each joined to its line's end. The axes' limits must be set.

    Args:
        gap: between the middles of two texts, as a part of the axes' height.
    """
    to_axes = axes.transData + axes.transAxes.inverted()
    heights = [to_axes.transform((end.x, end.y))[1] for end in ends]
    for end, height in zip(ends, spread(np.array(heights), gap).tolist(), strict=True):
        axes.annotate(
            end.text,
            (end.x, end.y),
            (1.05, height),
            textcoords="axes fraction",
            color=end.color,
            fontsize=fontsize,
            va="center",
            annotation_clip=False,
            arrowprops={"arrowstyle": "-", "color": end.color, "linewidth": 0.7, "shrinkA": 1, "shrinkB": 2},
        )


def spread(heights: Array, gap: float) -> Array:
    """Heights in the same order, at least a gap apart, each as near to where it was as that lets it be simply.

    Half-way between pushing upwards from below and pushing downwards from above: both keep order and gap.
    """
    order = np.argsort(heights, kind="stable")
    steps = gap * np.arange(len(heights))
    sorted_heights = heights[order]
    upwards = np.maximum.accumulate(sorted_heights - steps) + steps
    downwards = np.minimum.accumulate((sorted_heights - steps)[::-1])[::-1] + steps
    result = np.empty(len(heights))
    result[order] = (upwards + downwards) / 2
    return result
