"""Growth over a plane: the measured field in colour, the predicted boundary as a line over it."""

from __future__ import annotations

from typing import Any

import numpy as np

from experiments.limits.stability_map import StabilityMap
from reference.state import Array
from report.figures import BLACK_ON_COLOURS, TITLE, Picture, new_figure

#: Growth per step at which the colours end, and below which it counts as none.
MOST, LEAST = 0.05, 1e-3


def draw_map(found: StabilityMap) -> Picture:
    """One map with its scale."""
    figure, axes = new_figure(figsize=(8, 5.4))
    add_scale(figure, axes, draw_field(axes, found))
    return Picture(figure, words(found))


def draw_field(axes: Any, found: StabilityMap) -> Any:
    """The field from blue (dying away) to red (growing), the boundary in black; returns what the scale is of."""
    from matplotlib.colors import SymLogNorm

    norm = SymLogNorm(LEAST, vmin=-MOST, vmax=MOST)
    field = axes.pcolormesh(
        found.x_values, found.y_values, np.clip(found.growth, -MOST, MOST), cmap="RdBu_r", norm=norm, rasterized=True
    )
    if len(found.line):
        axes.plot(*found.line.T, "-", color=BLACK_ON_COLOURS, linewidth=2)
    if found.predicted_limit is not None and _crosses(found.predicted_limit[2]):
        xs, ys, limit = found.predicted_limit
        axes.contour(xs, ys, limit, levels=[1.0], colors=BLACK_ON_COLOURS, linewidths=2)
    for limits, values in ((axes.set_xlim, found.x_values), (axes.set_ylim, found.y_values)):
        if len(values) > 1:
            limits(values[0], values[-1])
    axes.grid(visible=False)
    axes.set_xlabel(found.x.heading)
    axes.set_ylabel(found.y.heading)
    axes.set_title(f"{found.stepper}\n{_prediction(found)}", loc="left", fontsize=TITLE)
    return field


def add_scale(figure: Any, axes: Any, field: Any) -> None:
    """What the colours mean."""
    bar = figure.colorbar(field, ax=axes, label="measured growth in a step [1]")
    bar.set_ticks([-MOST, -0.01, -LEAST, 0, LEAST, 0.01, MOST])
    bar.set_ticklabels(["-5 % or less", "-1 %", "-0.1 %", "0", "0.1 %", "1 %", "5 % or more"])


def words(found: StabilityMap) -> str:
    """The map for those who cannot see it."""
    stable = float(np.mean(found.growth <= LEAST))
    plane = f"{found.x.name} and {found.y.name}"
    return f"Map of growth over {plane} for {found.stepper}: {stable:.0%} of it is stable."


def _crosses(limit: Array) -> bool:
    """Whether the largest stable dt over dt is 1 somewhere on a plane."""
    return bool(np.nanmin(limit) < 1 < np.nanmax(limit))


def _prediction(found: StabilityMap) -> str:
    if found.predicted_limit is not None and not _crosses(found.predicted_limit[2]):
        word = "stable" if np.nanmin(found.predicted_limit[2]) >= 1 else "unstable"
        return f"{found.predicted_by}: predicted to be {word} on all of this plane"
    if len(found.line) or found.predicted_limit is not None:
        return f"black: predicted limit of\n{found.predicted_by}"
    return f"{found.predicted_by}: predicted to have no limit here, being stable or unstable at any dt"
