"""Error against wall time, and steps per second against the number of masses, for schemes and engines."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from experiments.cost import ANCHOR, DT, DURATION, MASSES, Cost, anchor, rounded
from experiments.experiment import Result
from report.figures import Picture, look, new_figure

#: The figure's height [inches], and how much of it a line of the legend takes: with many steppers, the figure grows.
HEIGHT, LINE = 6.0, 0.18


def draw(result: Result) -> Picture:
    """Schemes dashed and hollow, engines full: lines of equal error are the same scheme at another price."""
    costs: list[Cost] = [cost for cost in result.data["costs"] if cost.points]
    lines = sum(1 + _label(cost).count("\n") for cost in costs)
    figure, (left, right) = new_figure(ncols=2, figsize=(13, max(HEIGHT, LINE * (lines + 3))))
    kinds = [[c for c in costs if c.runs_as == "engine"], [c for c in costs if c.runs_as != "engine"]]
    for group in kinds:
        for i, cost in enumerate(group):
            _line(left, [(p.seconds, p.error) for p in cost.points if np.isfinite(p.error)], cost, i, _label(cost))
            _line(right, cost.steps_per_second, cost, i, None)
    for axes in (left, right):
        axes.set_xscale("log")
        axes.set_yscale("log")
    left.set_xlabel(f"wall time of {DURATION:g} s of motion [s]")
    left.set_ylabel("largest distance of any mass from the truth at the end [m]")
    left.set_title(f"Measured: a string of {MASSES[0]} masses, five dt", loc="left", fontsize=11)
    right.set_xlabel("masses")
    right.set_ylabel("steps per second [1/s]")
    right.set_title("Measured: speed on larger strings", loc="left", fontsize=11)
    figure.legend(loc="outside right center", frameon=False, title="stepper = its scheme", alignment="left", fontsize=9)
    return Picture(figure, _alt(costs))


def _line(axes: Any, points: Sequence[tuple[float, float]], cost: Cost, i: int, label: str | None) -> None:
    """One stepper. Colours and markers come twice: filling and dashes tell engines from schemes."""
    if not points:
        return
    full = cost.runs_as == "engine"
    filled = "full" if full else "none"
    x, y = zip(*points, strict=True)
    axes.plot(x, y, "-" if full else "--", label=label, fillstyle=filled, linewidth=1.2, markersize=6, **look(i))


def _label(cost: Cost) -> str:
    if cost.runs_as == "engine":
        return f"{cost.stepper.name}\n= {cost.identified_as or 'not known'}"
    return f"{cost.stepper.name} ({cost.runs_as})"


def _alt(costs: list[Cost]) -> str:
    parts = []
    for cost in costs:
        point = next(p for p in cost.points if p.dt == DT)
        slower = point.seconds / round(DURATION / DT) / anchor(costs)
        parts.append(f"{cost.stepper.name} ({cost.runs_as}) {point.error:.1e} m, {rounded(slower)}")
    return (
        "Left: logarithmic plot of error against wall time. Right: steps per second against masses. Of each stepper "
        f"its error at dt = {DT:g} s and the time of a step in steps of the {ANCHOR} kernel: {'; '.join(parts)}."
    )
