"""How long a step each engine takes on a user's own scene: limits, and the scene's own dt."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from experiments.advice.advice import Advice
from experiments.experiment import Result
from reference.scenes import Setup
from report.figures import COLOURS, MEASURED, NOTE, PREDICTED, Picture, few_ticks, new_figure

#: The axis goes this many times beyond its numbers to the left; to the right, where words stand, a part of itself.
LEFT, RIGHT = 2.0, 0.35

#: Beyond this quotient of numbers on the axis, 1, 2 and 5 of every decade would run into one another.
FEW_DECADES = 100

#: How a scene that does not come to its end is said to have ended.
ENDED = {"diverged": "blows up", "crashed": "crashes", "timed out": "takes too long"}


def draw(result: Result) -> Picture:
    """A row for each engine that takes the scene: a bar where its limit is predicted, a dot where it is measured."""
    setup: Setup = result.data["setup"]
    able = [advice for advice in result.data["advice"] if advice.own.ending != "unsupported"]
    rows = sorted(able, key=lambda advice: advice.limit or 0.0)
    figure, axes = new_figure(figsize=(9.5, 1.7 + 0.3 * max(len(rows), 1)))
    numbers = [setup.dt, *(n for a in rows for n in (a.predicted.dt, a.measured.dt) if n is not None)]
    axes.set_xscale("log")
    left = min(numbers) / LEFT
    axes.set_xlim(left, max(numbers) * max(4.0, (max(numbers) / left) ** RIGHT))
    axes.set_ylim(len(rows) - 0.4, -1.6)
    axes.axvline(setup.dt, color=COLOURS[0], linestyle="--", linewidth=1.4)
    axes.text(setup.dt, -1.1, f" the scene's dt, {setup.dt:g} s", color=COLOURS[0], fontweight="bold", va="center")
    for y, advice in enumerate(rows):
        _row(axes, y, advice, setup)
    axes.set_yticks(range(len(rows)), [advice.engine for advice in rows])
    axes.tick_params(axis="y", length=0)
    axes.grid(visible=False, axis="y")
    if max(numbers) < FEW_DECADES * min(numbers):
        few_ticks(axes)
    axes.set_xlabel("largest stable dt [s]: predicted (bar), measured (dot)")
    return Picture(figure, _alt(setup, rows))


def _row(axes: Any, y: int, advice: Advice, setup: Setup) -> None:
    if advice.predicted.dt is not None:
        axes.plot([advice.predicted.dt] * 2, [y - 0.35, y + 0.35], **{**PREDICTED, "linewidth": 2})
    if advice.measured.dt is not None:
        axes.plot(advice.measured.dt, y, color=COLOURS[1], **MEASURED)
    right = max(n for n in (advice.predicted.dt, advice.measured.dt, setup.dt) if n is not None)
    axes.text(1.12 * right, y, _words(advice, setup), fontsize=NOTE, va="center", color="#555555")


def _words(advice: Advice, setup: Setup) -> str:
    ended = "" if advice.own.ending == "done" else f"{ENDED[advice.own.ending]}; "
    if advice.limit is None:
        return f"{ended}limit not measured"
    if setup.dt > advice.limit:
        return f"{ended}dt is {setup.dt / advice.limit:.2f} times the limit"
    if ended:
        return f"{ended}not for its dt, margin {advice.limit / setup.dt:.2f}"
    return f"stable, margin {advice.limit / setup.dt:.2f}"


def _alt(setup: Setup, rows: Sequence[Advice]) -> str:
    parts = [
        f"{a.engine} {a.limit:.3g} s, {_words(a, setup)}" if a.limit else f"{a.engine} limit not measured" for a in rows
    ]
    return f"Largest stable steps against the scene's dt of {setup.dt:g} s: {'; '.join(parts) or 'of no engine'}."
