"""What permuting masses and springs changes, stepper by stepper, and in Pymunk with more and more rounds."""

from __future__ import annotations

from typing import Any

import numpy as np

from experiments.experiment import Result
from experiments.numbering import DAMPINGS, ROUNDS, Convergence, Row, names
from experiments.runs.permutation import CHANGES
from report.figures import TITLE, Picture, from_nothing, look, new_figure

#: Where no difference at all is drawn: a logarithm has no place for it.
FLOOR = 1e-18


def draw(result: Result) -> Picture:
    """Dots on a logarithmic axis on the left, with damped springs; lines against the rounds on the right."""
    rows: list[Row] = [row for row in result.data["rows"] if row.damping == DAMPINGS[0]]
    convergences: list[Convergence] = result.data["convergences"]
    figure, (left, right) = new_figure(ncols=2, figsize=(13, 7.6), width_ratios=[1.35, 1])
    _dots(left, rows, result.data["rounding"])
    _lines(right, convergences, result.data["rounding"])
    return Picture(figure, _alt(rows, convergences, result.data["rounding"]))


def _dots(axes: Any, rows: list[Row], rounding: float) -> None:
    axes.axvspan(FLOOR / 10, rounding, color="#f0f0f0")
    axes.axvline(rounding, color="#777777", linewidth=1)
    for i, change in enumerate(CHANGES):
        # One under the other, so that all can be seen where they are equal.
        places = [(max(row.effects.distances[change], FLOOR), y + 0.24 * (i - 1)) for y, row in _placed(rows, change)]
        axes.plot(*zip(*places, strict=True), linestyle="none", label=change, **look(i))
    axes.set_xscale("log")
    axes.set_xlim(FLOOR / 4, 1)
    from_nothing(axes.xaxis, FLOOR)
    axes.set_ylim(len(rows) - 0.4, -0.6)
    axes.set_yticks(range(len(rows)), [row.stepper.name for row in rows])
    axes.set_xlabel("largest distance from the motion before the permutation [m]")
    axes.annotate(
        "rounding", (rounding, 0), (-6, 0), textcoords="offset points", ha="right", va="center", color="#555555"
    )
    beside = {"transform": axes.get_yaxis_transform(), "va": "center", "color": "#333333"}
    # Above the legend, whose last entry reaches as far.
    axes.text(1.02, 1.05, "predicted:\norder of", transform=axes.transAxes, va="bottom", color="#333333")
    for y, row in enumerate(rows):
        axes.text(1.02, y, names(row.predicted) or "-", fontweight="bold" if row.predicted else None, **beside)
    axes.set_title(f"Measured: springs damped with {DAMPINGS[0]:g} N s/m", loc="left", fontsize=TITLE, pad=28)
    axes.legend(
        loc="lower left",
        bbox_to_anchor=(0, 1.0),
        ncols=3,
        borderaxespad=0,
        borderpad=0.2,
        columnspacing=0.8,
        handletextpad=0,
        frameon=False,
    )


def _placed(rows: list[Row], change: str) -> list[tuple[int, Row]]:
    return [(y, row) for y, row in enumerate(rows) if change in row.effects.distances]


def _lines(axes: Any, convergences: list[Convergence], rounding: float) -> None:
    axes.axhspan(FLOOR / 10, rounding, color="#f0f0f0")
    axes.axhline(rounding, color="#777777", linewidth=1)
    for i, side, c in zip((3, 7), (-8, 8), convergences, strict=True):
        distances = np.maximum(c.distances, FLOOR)
        axes.plot(ROUNDS, distances, "-", **look(i))
        default = ROUNDS.index(10)
        more = np.arange(ROUNDS[default], ROUNDS[-1] + 1)
        slope = distances[default] * c.predicted ** (more - ROUNDS[default])
        above = slope > rounding
        if not above.any():
            continue
        axes.plot(more[above], slope[above], ":", color="#333333", linewidth=2.2)
        note = f"damping {c.damping:g} N s/m\npredicted (dotted):\na round leaves {c.predicted:.2f}"
        end = (more[above][-1], rounding)
        axes.annotate(note, end, (10, side), textcoords="offset points", va="bottom" if side > 0 else "top")
    axes.set_yscale("log")
    axes.set_xlim(0, 1.15 * ROUNDS[-1])
    axes.set_ylim(FLOOR / 4, 1)
    from_nothing(axes.yaxis, FLOOR)
    axes.set_xlabel("rounds of sequential impulses in a step [1]")
    axes.set_ylabel("largest distance from the motion before the permutation [m]")
    axes.set_title("Measured: Pymunk, springs reversed", loc="left", fontsize=TITLE)


def _alt(rows: list[Row], convergences: list[Convergence], rounding: float) -> str:
    seen = [
        f"{row.stepper.name} {max(row.effects.distances.values()):.1e} m"
        for row in rows
        if row.effects.depends_on(rounding)
    ]
    parts = [
        f"{c.damping:g} N s/m: {c.distances[0]:.1e} m with 1 round, {c.distances[-1]:.1e} m with {ROUNDS[-1]}"
        for c in convergences
    ]
    return (
        f"Left: dots of what permuting masses and springs changes; above rounding are only "
        f"{', '.join(seen) or 'none'}. Right: Pymunk's difference against its rounds, {'; '.join(parts)}."
    )
