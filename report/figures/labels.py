"""Labels beside the lines they name, moved apart so that all can be read."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from reference.state import Array
from report.figures import NOTE


@dataclass(frozen=True)
class End:
    """Where a line ends, in the axes' data, and what is to be said of it there."""

    x: float
    y: float
    text: str
    color: str


def label_ends(axes: Any, ends: Sequence[End], line: float, fontsize: float = NOTE, together: float = 0.0) -> None:
    """Write the texts to the right of the axes, each joined to its line's end. The axes' limits must be set.

    Args:
        line: the height of a line of text, as a part of the axes' height.
        together: ends no farther apart than this part of the axes' height have their texts in one, in their order.
    """
    if not ends:
        return
    to_axes = axes.transData + axes.transAxes.inverted()
    heights = np.array([to_axes.transform((end.x, end.y))[1] for end in ends])
    if together:
        groups = gathered(heights, together)
        ends, heights = [_joined([ends[i] for i in group]) for group in groups], heights[[g[0] for g in groups]]
    sizes = np.array([line * (1 + end.text.count("\n")) for end in ends])
    for end, height in zip(ends, spread(heights, sizes).tolist(), strict=True):
        axes.annotate(
            end.text,
            (end.x, end.y),
            (1.06, height),
            textcoords="axes fraction",
            color="#222222",
            fontsize=fontsize,
            va="center",
            annotation_clip=False,
            arrowprops={"arrowstyle": "-", "color": end.color, "relpos": (0, 0.5)},
        )


def gathered(heights: Array, together: float) -> list[list[int]]:
    """The numbers of heights that are near to one another, from group to group upwards, in a group in their order."""
    order = np.argsort(heights, kind="stable")
    apart = np.flatnonzero(np.diff(heights[order]) > together) + 1
    return [sorted(group.tolist()) for group in np.split(order, apart)]


def _joined(ends: Sequence[End]) -> End:
    """One end for all; grey where their lines have several colours."""
    colours = {end.color for end in ends}
    text = "\n".join(end.text for end in ends)
    return End(ends[0].x, ends[0].y, text, ends[0].color if len(colours) == 1 else "#777777")


def spread(heights: Array, sizes: Array) -> Array:
    """Middles of boxes of these sizes between 0 and 1, none over another, in their order and near where they were.

    Half-way between pushing upwards from below and pushing downwards from above: both keep the order and the sizes.
    """
    order = np.argsort(heights, kind="stable")
    wanted, sizes = heights[order], sizes[order]
    # Where each would be if they stood on one another from 0 on; less that, heights need only not fall.
    stacked = np.cumsum(sizes) - sizes / 2
    upwards = np.maximum.accumulate(wanted - stacked)
    downwards = np.minimum.accumulate((wanted - stacked)[::-1])[::-1]
    room = max(1 - float(sizes.sum()), 0.0)
    result = np.empty(len(heights))
    result[order] = np.clip((upwards + downwards) / 2, 0, room) + stacked
    return result
