"""Engines against the true motion (above) and against the schemes they are identified with (below), over time."""

from __future__ import annotations

import numpy as np

from experiments.comparison import Comparison, Run
from experiments.experiment import Result
from reference.state import Array
from report.figures import Picture, look, new_figure

#: Where no difference at all is drawn: a logarithm has no place for it.
FLOOR = 1e-17

#: The figure's height [inches], and how much of it an engine takes in the legend: with many, the figure grows.
HEIGHT, ENTRY = 5.8, 0.35


def draw(result: Result) -> Picture:
    """Two bands of lines on one logarithmic axis: what is to be explained, and what is left of it once it is."""
    comparison: Comparison = result.data["comparison"]
    runs = [run for run in comparison.runs if run.stepper.kind == "engine" and run.error is not None]
    figure, axes = new_figure(figsize=(10, max(HEIGHT, ENTRY * (len(runs) + 2))))
    times = comparison.times
    for i, run in enumerate(runs):
        _line(axes, times, run.error, i, len(runs), "-", _label(run))
        _line(axes, times, run.deviation, i, len(runs), "--", None)
    axes.set_yscale("log")
    axes.set_ylim(FLOOR / 2, 10)
    axes.set_xlim(0, times[-1])
    axes.set_xlabel("time [s]")
    axes.set_ylabel("largest distance of any mass [m]")
    note = {"transform": axes.get_yaxis_transform(), "fontsize": 11, "fontweight": "bold", "color": "#333333"}
    axes.text(0.01, 2.0, "measured: from the true motion (solid)", **note)
    axes.text(0.01, 1e-12, "identified: from the scheme named on the right (dashed)", **note)
    if runs:
        place = {"loc": "center left", "bbox_to_anchor": (1.0, 0.5), "alignment": "left"}
        axes.legend(title="engine = its scheme", fontsize=9, **place)
    return Picture(figure, _alt(runs))


def _line(axes: object, times: Array, values: Array | None, i: int, count: int, style: str, label: str | None) -> None:
    if values is None:
        return
    values = np.where(np.isfinite(values), np.maximum(values, FLOOR), np.nan)
    every = max(1, len(times) // 8)
    # Markers of different runs at different times: where lines lie on one another, all can still be seen.
    start = 1 + i * every // max(count, 1)
    axes.plot(times[: len(values)], values, style, label=label, markevery=(start, every), markersize=6, **look(i))  # type: ignore[attr-defined]


def _label(run: Run) -> str:
    return f"{run.stepper.name}\n= {run.identification.identified_as or 'not identified'}"


def _alt(runs: list[Run]) -> str:
    parts = []
    for run in runs:
        assert run.error is not None
        named = run.identification.identified_as
        why = f"{run.identification.error:.1e} m from {named}" if named else "not identified"
        parts.append(f"{run.stepper.name}: up to {run.error.max():.1e} m from the true motion, {why}")
    return "Logarithmic plot of distances over time. " + "; ".join(parts) + "."
