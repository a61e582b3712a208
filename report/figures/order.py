"""Error against dt, family by family: the slopes are the orders, and engines lie on the lines of their schemes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from experiments.experiment import Result
from experiments.order import DTS, DURATION, Row
from report.figures import NOTE, TITLE, Picture, look, new_figure
from report.figures.labels import End, label_ends

#: Slopes to compare with, each with an error [m] at the largest dt that keeps it off the lines.
SLOPES = {1: 6e-2, 2: 6e-4, 4: 3e-6}

LOWEST, HIGHEST = 1e-16, 1e-1

#: The figure's height [inches] up to this number of lines of labels beside a panel; with more, the figure grows.
HEIGHT, LINES = 9.5, 20

#: Lines that end no farther apart than this part of a panel's height have their labels in one.
TOGETHER = 0.012


def draw(result: Result) -> Picture:
    """A panel for each family: lines are schemes, rings are engines."""
    rows: Sequence[Row] = result.data["rows"]
    families = _families(rows)
    lines = max(LINES, *map(len, families.values()))  # each row of a family has its line
    size = (12.5, HEIGHT * lines / LINES)
    figure, axes = new_figure(nrows=2, ncols=2, sharex=True, sharey=True, figsize=size)
    for panel, (title, family) in zip(axes.flat, families.items(), strict=True):
        _panel(panel, title, family, 1 / lines)
    for panel in axes[1]:
        panel.set_xlabel("dt [s]")
    for panel in axes[:, 0]:
        panel.set_ylabel(f"error after {DURATION:g} s [m]")
    return Picture(figure, _alt(rows))


def _families(rows: Sequence[Row]) -> dict[str, list[Row]]:
    """Who is drawn with whom, by what they are."""
    engines = [row for row in rows if row.stepper.kind == "engine"]
    on_springs = [row for row in engines if row.scheme is None or not row.scheme.on_rods]
    theirs = [row.scheme.name for row in on_springs if row.scheme]
    return {
        "Schemes, and their measured slopes": [row for row in rows if row.stepper.kind == "scheme"],
        "Written in place, and the lecture's listings": [r for r in rows if r.stepper.kind in ("in_place", "lecture")],
        "Engines (rings) on the lines of their schemes": [
            row
            for row in rows
            if row.stepper.kind == "engine_scheme" or row.stepper.name in theirs or row in on_springs
        ],
        "With distance constraints: pendulum, rope, and engines (rings)": [
            row for row in rows if row.stepper.kind == "pendulum" or (row in engines and row not in on_springs)
        ],
    }


def _panel(axes: Any, title: str, rows: Sequence[Row], line: float) -> None:
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlim(0.8 * DTS[-1], 1.25 * DTS[0])
    axes.set_ylim(LOWEST, HIGHEST)
    axes.set_title(title, loc="left", fontsize=TITLE)
    for slope, error in SLOPES.items():
        axes.plot(DTS, error * (DTS / DTS[0]) ** slope, ":", color="#777777", linewidth=1.2)
        middle = len(DTS) // 2
        axes.annotate(
            f"slope {slope}",
            (DTS[middle], error * (DTS[middle] / DTS[0]) ** slope),
            (-2, 4),
            textcoords="offset points",
            color="#555555",
            fontsize=NOTE,
            ha="right",
        )
    lines = [row for row in rows if row.stepper.kind != "engine" and np.isfinite(row.errors[0])]
    rings = [row for row in rows if row.stepper.kind == "engine"]
    ends = []
    for i, row in enumerate(lines):
        # Markers of different lines at different dt: where lines lie on one another, all can still be seen.
        axes.plot(DTS, row.errors, "-", markevery=(i % 3, 3), **look(i))
        ends.append(End(DTS[0], row.errors[0], _label(row, rings), look(i)["color"]))
    for row in rings:
        axes.plot(DTS, row.errors, "o", fillstyle="none", color="#000000", markersize=9, markeredgewidth=0.9)
    named = [(row.stepper.name, row.string) for row in lines]
    strangers = [row for row in rings if (row.scheme is None or (row.scheme.name, row.string) not in named)]
    ends += [End(DTS[0], r.errors[0], _label(r, []), "#000000") for r in strangers if np.isfinite(r.errors[0])]
    label_ends(axes, ends, line, together=TOGETHER)


def _label(row: Row, rings: Sequence[Row]) -> str:
    slope = "no slope" if row.slope is None else f"{row.slope:.2f}"
    line = row.stepper.name, row.string
    engines = [ring.stepper.name for ring in rings if ring.scheme and (ring.scheme.name, ring.string) == line]
    return f"{row.stepper.name} {slope}" + "".join(f"\n   o {engine}" for engine in engines)


def _alt(rows: Sequence[Row]) -> str:
    slopes = [f"{row.stepper.name} {row.slope:.2f}" for row in rows if row.slope is not None]
    return f"Errors against dt, both axes logarithmic; slopes: {', '.join(slopes)}."
