"""The report's maps of stability, side by side on one scale."""

from __future__ import annotations

from collections.abc import Sequence

from experiments.experiment import Result
from experiments.limits.stability_map import StabilityMap
from report.figures import Picture, new_figure
from report.figures.stability_map import add_scale, draw_field, words


def draw(result: Result) -> Picture:
    """One panel per map."""
    maps: Sequence[StabilityMap] = result.data["maps"]
    figure, panels = new_figure(ncols=max(len(maps), 1), figsize=(13, 4.4), squeeze=False)
    fields = [draw_field(axes, found) for axes, found in zip(panels.flat, maps, strict=False)]
    if fields:
        add_scale(figure, panels, fields[0])
    return Picture(figure, " ".join(map(words, maps)) or "No map could be made.")
