"""A string at several times, with more and with less drag, and its energy meanwhile."""

from __future__ import annotations

from typing import Any

import numpy as np

from experiments.experiment import Result
from experiments.less_damping import DURATION, TIMES, Swing
from report.figures import TITLE, Picture, look, new_figure
from report.figures.filmstrip import Strip, draw_row

#: How far the string reaches from its anchor to either side, below and above [m].
FRAME = (1.35, 1.5, 0.35)


def draw(result: Result) -> Picture:
    """A row of a film for each drag, and below them the energies."""
    swings: list[Swing] = result.data["swings"]
    figure, axes = new_figure(nrows=len(swings) + 1, figsize=(11, 7.5), height_ratios=[*(1 for _ in swings), 2.2])
    for i, (row, swing) in enumerate(zip(axes, swings, strict=False)):
        style = {**look(i), "markersize": 3, "linewidth": 1.2}
        draw_row(row, [Strip(swing.motion, style)], TIMES, FRAME)
        row.set_title(f"drag {swing.drag:g} N s/m", loc="left", fontsize=TITLE, color=look(i)["color"])
    _energies(axes[-1], swings)
    return Picture(figure, _alt(swings))


def _energies(axes: Any, swings: list[Swing]) -> None:
    for i, swing in enumerate(swings):
        times = swing.motion.times
        axes.plot(times, swing.energies, markevery=200, **look(i))
        small = swing.energies[0] * np.exp(-times / swing.predicted)
        axes.plot(times, small, ":", color="#333333")
        if swing.measured is not None:
            style = {"color": look(i)["color"], "markeredgecolor": "#333333", "markersize": 9, "zorder": 3}
            axes.plot(swing.measured, swing.energies[0] / np.e, marker="*", linestyle="", **style)
        axes.annotate(
            f"{swing.drag:g} N s/m", (times[-1], swing.energies[-1]), (6, 0), textcoords="offset points", va="center"
        )
    axes.set_yscale("log")
    axes.set_xlim(0, 1.1 * DURATION)
    axes.set_xlabel("time [s]")
    axes.set_ylabel("energy above rest [J]")
    axes.set_title(
        "Measured (star: fallen to 1/e), and predicted for small swings (dotted): exp(-t Cd/m)",
        loc="left",
        fontsize=TITLE,
    )


def _alt(swings: list[Swing]) -> str:
    parts = [
        f"with drag {s.drag:g} N s/m {s.energies[-1] / s.energies[0]:.1e} of the energy is left after {DURATION:g} s"
        + (f", 1/e at {s.measured:.2g} s" if s.measured is not None else ", 1/e not before the end")
        for s in swings
    ]
    return f"A string drawn at {len(TIMES)} times up to {TIMES[-1]:g} s, and its energy: {'; '.join(parts)}."
