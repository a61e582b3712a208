"""Error against wall time, and steps per second against the number of masses, for schemes and engines."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from textwrap import fill
from typing import Any

import numpy as np

from experiments.cost import ANCHOR, DT, DURATION, MASSES, Cost, anchor, rounded
from experiments.experiment import Result
from reference.state import Array
from report.figures import NOTE, TITLE, Picture, look, new_figure

#: The figure's height [inches], how much of it a line of the legend takes, and how many letters are in one.
HEIGHT, LINE, LETTERS = 6.0, 0.18, 34


@dataclass(frozen=True)
class Group:
    """Steppers that are the same scheme, at different prices.

    Attributes:
        name: of the scheme; of a stranger, its own.
        kind: engine, kernel or Python.
        costs: the steppers, at least one.
    """

    name: str
    kind: str
    costs: Sequence[Cost]

    @property
    def label(self) -> str:
        """The scheme and who is it."""
        if self.kind != "engine":
            return f"{self.name} ({self.kind})"
        return f"{self.name}:\n{fill(', '.join(cost.stepper.name for cost in self.costs), LETTERS)}"

    @property
    def errors(self) -> tuple[Array, Array, Array]:
        """By dt: least and most wall time [s], and the error [m], not a number where one of them has none."""
        seconds = np.array([[point.seconds for point in cost.points] for cost in self.costs])
        errors = np.array([[point.error for point in cost.points] for cost in self.costs])
        errors = np.where(np.isfinite(errors).all(axis=0), errors.max(axis=0), np.nan)
        return seconds.min(axis=0), seconds.max(axis=0), errors

    @property
    def speeds(self) -> tuple[Array, Array, Array]:
        """Masses, and the least and most steps per second [1/s]; no least where not all came so far."""
        known: dict[int, list[float]] = {}
        for cost in self.costs:
            for masses, speed in cost.steps_per_second:
                known.setdefault(masses, []).append(speed)
        counts = sorted(known)
        least = [min(known[n]) if len(known[n]) == len(self.costs) else np.nan for n in counts]
        return np.array(counts), np.array(least), np.array([max(known[n]) for n in counts])


def draw(result: Result) -> Picture:
    """One line for each scheme, engines solid, our own dashed; between a scheme's cheapest and dearest it is shaded."""
    costs: list[Cost] = [cost for cost in result.data["costs"] if cost.points]
    groups = _groups(costs)
    lines = sum(1 + group.label.count("\n") for group in groups)
    figure, (left, right) = new_figure(ncols=2, figsize=(13, max(HEIGHT, LINE * (lines + 3))))
    looks = {name: look(i) for i, name in enumerate(dict.fromkeys(group.name for group in groups))}
    for group in groups:
        _errors(left, group, looks[group.name])
        _speeds(right, group, looks[group.name])
    for axes in (left, right):
        axes.set_xscale("log")
        axes.set_yscale("log")
    left.set_xlabel(f"wall time of {DURATION:g} s of motion [s]")
    left.set_ylabel("largest distance of any mass from the true motion at the end [m]")
    left.set_title(f"Measured: a string of {MASSES[0]} masses, five dt", loc="left", fontsize=TITLE)
    right.set_xlabel("masses [1]")
    right.set_ylabel("steps per second [1/s]")
    right.set_title("Measured: speed on larger strings", loc="left", fontsize=TITLE)
    title = "scheme: engines (solid), our own (dashed);\nshaded: from cheapest to dearest"
    figure.legend(loc="outside right center", title=title, alignment="left", fontsize=NOTE, title_fontsize=NOTE)
    return Picture(figure, _alt(costs))


def _groups(costs: Sequence[Cost]) -> list[Group]:
    """Engines by the scheme they are identified as, then schemes, each alone."""
    engines: dict[str, list[Cost]] = {}
    for cost in costs:
        if cost.runs_as == "engine":
            engines.setdefault(cost.identified_as or cost.stepper.name, []).append(cost)
    ours = [Group(cost.stepper.name, cost.runs_as, [cost]) for cost in costs if cost.runs_as != "engine"]
    return [*(Group(name, "engine", some) for name, some in engines.items()), *ours]


def _errors(axes: Any, group: Group, style: dict[str, str]) -> None:
    cheapest, dearest, errors = group.errors
    axes.plot(cheapest, errors, _dashes(group), label=group.label, linewidth=1.2, **style)
    if len(group.costs) > 1:
        known = np.isfinite(errors)
        axes.fill_betweenx(errors[known], cheapest[known], dearest[known], color=style["color"], alpha=0.2, linewidth=0)


def _speeds(axes: Any, group: Group, style: dict[str, str]) -> None:
    masses, least, most = group.speeds
    axes.plot(masses, most, _dashes(group), linewidth=1.2, **style)
    if len(group.costs) > 1:
        axes.fill_between(masses, least, most, color=style["color"], alpha=0.2, linewidth=0)


def _dashes(group: Group) -> str:
    return "-" if group.kind == "engine" else "--"


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
