"""The same string under Euler and under Heun at several times, and how far each is from the true motion."""

from __future__ import annotations

from typing import Any

import numpy as np

from experiments.experiment import Result
from experiments.first_order_instability import DT, GROWING, TIMES, Fate, last
from report.figures import TITLE, Picture, look, new_figure
from report.figures.filmstrip import Strip, draw_row

#: How far a frame reaches from the anchor to either side, below and above [m].
FRAME = (1.4, 1.7, 0.6)

#: The true motion, beneath.
TRUE = {"color": "#bbbbbb", "linewidth": 4, "solid_capstyle": "round"}


def draw(result: Result) -> Picture:
    """A row of a film for each scheme over the true motion, and below them the distances with the predicted growth."""
    fates: list[Fate] = result.data["fates"]
    figure, axes = new_figure(nrows=len(fates) + 1, figsize=(11, 7.2), height_ratios=[*(1 for _ in fates), 2.4])
    for i, (row, fate) in enumerate(zip(axes, fates, strict=False)):
        style = {**look(i), "markersize": 3, "linewidth": 1.2}
        draw_row(row, [Strip(result.data["true"], TRUE), Strip(fate.motion, style)], TIMES, FRAME)
        row.set_title(f"{fate.scheme.name}, dt = {DT:g} s (true motion in grey)", loc="left", fontsize=TITLE)
    _distances(axes[-1], fates)
    return Picture(figure, _alt(fates))


def _distances(axes: Any, fates: list[Fate]) -> None:
    for i, fate in enumerate(fates):
        times = DT * np.arange(len(fate.distance))
        shown = np.where(np.isfinite(fate.distance) & (fate.distance > 0), fate.distance, np.nan)
        axes.plot(times, shown, markevery=100, **look(i))
        axes.plot(times[: len(fate.mode)], fate.mode, color=look(i)["color"], linewidth=0.9)
        end = np.flatnonzero(np.isfinite(shown))[-1]
        axes.annotate(fate.scheme.name, (times[end], shown[end]), (6, 0), textcoords="offset points", va="center")
        if fate.swinging is not None:
            _predicted(axes, fate, times)
    axes.set_yscale("log")
    axes.set_ylim(1e-9, 100)
    axes.set_xlim(0, 1.08 * TIMES[-1])
    axes.set_xlabel("time [s]")
    axes.set_ylabel("distance from the true motion [m]")
    what = "Measured: largest distance of any mass (markers), and its part in the fastest mode (thin)"
    axes.set_title(what, loc="left", fontsize=TITLE)


def _predicted(axes: Any, fate: Fate, times: Any) -> None:
    """The slope of the predicted growth, above the fastest mode, up to where the fit ends."""
    end = int(np.flatnonzero(fate.mode > GROWING[1])[0])
    slope = 4 * GROWING[1] * fate.predicted ** ((times - times[end]) / DT)
    near = (times <= times[end]) & (slope > GROWING[0])
    axes.plot(times[near], slope[near], ":", color="#333333", linewidth=2)
    note = f"predicted: x {fate.predicted:.4f} a step"
    axes.annotate(note, (times[end], slope[end]), (-6, 4), textcoords="offset points", ha="right", color="#333333")


def _alt(fates: list[Fate]) -> str:
    ends = [f"{f.scheme.name} {'not a finite number' if last(f) is None else f'{last(f):.1e} m'}" for f in fates]
    growths = [f"{f.scheme.name} {f.predicted:.5f} predicted, {f.perturbed:.5f} measured" for f in fates]
    return (
        f"A string at {len(TIMES)} times under {' and '.join(f.scheme.name for f in fates)}, over its true motion; "
        f"distances from that at {TIMES[-1]:g} s: {', '.join(ends)}; growth of the fastest mode in a step: "
        f"{'; '.join(growths)}."
    )
