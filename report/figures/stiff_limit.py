"""The distance of a string from the pendulum it becomes, against its stiffness."""

from __future__ import annotations

import numpy as np

from experiments.experiment import Result
from report.figures import Picture, look, new_figure


def draw(result: Result) -> Picture:
    """Both distances, and the predicted slope through the last one."""
    rows = np.array([[np.nan if value is None else value for value in row] for row in result.data["rows"]], dtype=float)
    stiffness, to_pendulum, to_cable = rows.T
    figure, axes = new_figure(figsize=(8, 4.8))
    axes.plot(stiffness, to_pendulum[-1] * stiffness[-1] / stiffness, ":", color="#555555")
    axes.plot(stiffness, to_pendulum, linestyle="none", markersize=13, **look(0))
    axes.plot(stiffness, to_cable, linestyle="none", **look(1))
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("stiffness of the springs [N/m]")
    axes.set_ylabel("largest distance within 0.5 s [m]")
    axes.annotate(
        "predicted: 1/stiffness",
        (stiffness[0] * 2, to_pendulum[-1] * stiffness[-1] / stiffness[0] / 2),
        (10, 8),
        textcoords="offset points",
        color="#555555",
    )
    axes.annotate(
        "measured: to the pendulum (large dots)",
        (stiffness[2], to_pendulum[2]),
        (16, 14),
        textcoords="offset points",
        color=look(0)["color"],
    )
    axes.annotate(
        "measured: to MuJoCo's cable (squares on them)",
        (stiffness[3], to_pendulum[3]),
        (-20, -24),
        textcoords="offset points",
        ha="right",
        color=look(1)["color"],
    )
    numbers = ", ".join(f"{d:.2g} m at {k:g} N/m" for k, d in zip(stiffness, to_pendulum, strict=True))
    return Picture(
        figure, f"Logarithmic plot: a string's distance from the pendulum falls with its stiffness, {numbers}."
    )
