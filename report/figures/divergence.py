"""Engines against the true motion (above) and against the schemes they are identified with (below), over time."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import fill
from typing import Any

import numpy as np

from experiments.experiment import Result
from experiments.runs.comparison import Comparison, Run
from reference.state import Array
from report.figures import IDENTIFIED, TITLE, Picture, from_nothing, look, new_figure
from report.figures.labels import End, label_ends

#: Where no difference at all is drawn: a logarithm has no place for it.
FLOOR = 1e-17

#: The figure's height [inches], and of a line of its labels; a label's width in letters.
HEIGHT, LINE, LETTERS = 5.8, 0.17, 38


def draw(result: Result) -> Picture:
    """The engines' part of the experiment's comparison."""
    comparison: Comparison = result.data["comparison"]
    return draw_runs(comparison, [run for run in comparison.runs if run.stepper.kind == "engine"])


def draw_runs(comparison: Comparison, wanted: Sequence[Run]) -> Picture:
    """Two bands of lines on one logarithmic axis: what is to be explained, and what is left of it once it is.

    Args:
        wanted: runs of the comparison; those without an error are left out.
    """
    runs = [run for run in wanted if run.error is not None]
    groups = _groups(runs)
    lines = sum(1 + _label(group).count("\n") for group in groups)
    figure, axes = new_figure(figsize=(10.5, max(HEIGHT, LINE * (lines + 4))))
    times = comparison.times
    axes.set_yscale("log")
    axes.set_ylim(FLOOR / 2, max(10.0, 3 * max((_most(run.error) for run in runs), default=0.0)))
    from_nothing(axes.yaxis, FLOOR)
    axes.set_xlim(0, times[-1])
    axes.set_xlabel("time [s]")
    axes.set_ylabel("largest distance of any mass [m]")
    ends = []
    for i, group in enumerate(groups):
        error, deviation = _largest([run.error for run in group]), _largest([run.deviation for run in group])
        assert error is not None
        _line(axes, times, error, i, len(groups), "-", {})
        ends.append(End(times[len(error) - 1], float(_shown(error)[-1]), _label(group), look(i)["color"]))
        if deviation is not None:
            _line(axes, times, deviation, i, len(groups), "--", IDENTIFIED)
    note = {"transform": axes.get_yaxis_transform(), "fontsize": TITLE, "fontweight": "bold", "color": "#333333"}
    axes.text(0.01, 2.0, "measured: from the true motion (full markers)", **note)
    axes.text(0.05, 1e-12, "identified: from the scheme named on the right (hollow, dashed)", **note)
    label_ends(axes, [end for end in ends if np.isfinite(end.y)], LINE / figure.get_figheight() * 1.15, fontsize=8.5)
    return Picture(figure, _alt(runs))


def _groups(runs: Sequence[Run]) -> list[list[Run]]:
    """Runs identified as the same scheme, which are the same to rounding; a stranger is a group of its own."""
    groups: dict[str, list[Run]] = {}
    for run in runs:
        groups.setdefault(run.identification.identified_as or f"not identified: {run.stepper.name}", []).append(run)
    return list(groups.values())


def _largest(curves: Sequence[Array | None]) -> Array | None:
    """The largest of curves at each time, up to where the first of them ends."""
    known = [curve for curve in curves if curve is not None]
    if not known:
        return None
    shortest = min(len(curve) for curve in known)
    return np.asarray(np.max([curve[:shortest] for curve in known], axis=0))


def _shown(values: Array) -> Array:
    return np.where(np.isfinite(values), np.maximum(values, FLOOR), np.nan)


def _most(values: Array | None) -> float:
    """The largest that is a finite number."""
    finite = np.zeros(0) if values is None else values[np.isfinite(values)]
    return float(finite.max(initial=0.0))


def _line(axes: Any, times: Array, values: Array, i: int, count: int, style: str, marks: dict[str, Any]) -> None:
    every = max(1, len(times) // 6)
    # Markers of different lines at different times: where lines lie on one another, all can still be seen.
    start = 1 + i * every // max(count, 1)
    looks = {**look(i), **{name: value for name, value in marks.items() if name != "marker"}}
    axes.plot(times[: len(values)], _shown(values), style, markevery=(start, every), **looks)


def _label(group: Sequence[Run]) -> str:
    names = ", ".join(run.stepper.name for run in group)
    return f"{group[0].identification.identified_as or 'not identified'}:\n{fill(names, LETTERS)}"


def _alt(runs: list[Run]) -> str:
    parts = []
    for run in runs:
        assert run.error is not None
        named = run.identification.identified_as
        why = f"{run.identification.error:.1e} m from {named}" if named else "not identified"
        parts.append(f"{run.stepper.name}: up to {run.error.max():.1e} m from the true motion, {why}")
    return "Logarithmic plot of distances over time. " + "; ".join(parts) + "."
