"""The energy error of every stepper over time, and what each does to a free string's momentum."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import Any

import numpy as np

from experiments.energy import DURATION, Row
from experiments.experiment import Result
from reference.state import Array
from reference.theory.energy_trend import TRENDS
from report.figures import COLOURS, NOTE, TITLE, Picture, from_nothing, new_figure, powers
from report.figures.labels import End, label_ends

#: Each kind of energy's colour and marker; there is no marker if it could not be told.
LOOKS: dict[str | None, dict[str, str]] = {
    "bounded": {"color": COLOURS[2], "marker": "o"},
    "growing": {"color": COLOURS[1], "marker": "^"},
    "decaying": {"color": COLOURS[0], "marker": "v"},
    None: {"color": COLOURS[6], "marker": ""},
}

#: The largest error is drawn of each of this many spans of time.
SPANS = 20

LOWEST, HIGHEST = 1e-9, 1e5

#: What is beyond them is drawn on them, and their labels say so.
LABELS = {LOWEST: "$10^{-9}$ or less", **powers(*range(-7, 4, 2)), HIGHEST: "$10^{5}$ or more"}

#: The panels' heights [inches]: above; below, with no stepper, and for each.
ABOVE, BELOW, EACH = 6.9, 0.9, 0.155

#: What a kind of stepper is called in a label, where that is not its own word.
WORDS = {"engine_scheme": "engine scheme", "lecture": "lecture listing"}

#: Where no error at all is drawn: a logarithm has no place for it.
FLOOR = 1e-17


def draw(result: Result) -> Picture:
    """Energy above, one line for all steppers that do the same; momentum below, two dots for each."""
    rows: Sequence[Row] = result.data["rows"]
    free = [row for row in rows if row.momentum is not None]
    under = BELOW + EACH * len(free)
    figure, (above, below) = new_figure(nrows=2, figsize=(11, ABOVE + under), height_ratios=[ABOVE, under])
    _energy(above, rows)
    _momentum(below, free, result.data["rounding"])
    return Picture(figure, _alt(rows, free))


def _energy(axes: Any, rows: Sequence[Row]) -> None:
    axes.set_yscale("log")
    axes.set_xlim(0, DURATION)
    axes.set_ylim(LOWEST, HIGHEST)
    axes.set_yticks([*LABELS], [*LABELS.values()])
    axes.set_xlabel("time [s]")
    axes.set_ylabel("largest energy error in a second [1],\nas a part of what falling to rest releases")
    axes.set_title(
        "Measured: energy of an undamped string (dashed: distance constraints for springs; rings: engines)",
        loc="left",
        fontsize=TITLE,
    )
    ends: list[End] = []
    diverged: list[End] = []
    for group in _groups(rows):
        times, errors = _largest(group[0].times, group[0].errors)
        look, line = LOOKS[group[0].measured], "--" if _on_constraints(group[0]) else "-"
        axes.plot(times, errors, line, markevery=3, **look)
        if any(row.stepper.kind == "engine" for row in group):
            axes.plot(times, errors, "o", fillstyle="none", color="#000000", markersize=9, markevery=(1, 7))
        end = End(float(times[-1]), float(errors[-1]), _label(group), look["color"])
        (ends if group[0].outcome.ending == "done" else diverged).append(end)
    label_ends(axes, ends, line=0.031)
    beside = max((end.x for end in diverged), default=0.0) / DURATION + 0.04
    for i, end in enumerate(diverged):
        place = {"textcoords": "axes fraction", "fontsize": NOTE, "color": "#222222", "va": "center"}
        leader = {"arrowstyle": "-", "color": end.color, "relpos": (0, 0.5)}
        text = f"{end.text}, diverged at {end.x:.2g} s"
        axes.annotate(text, (end.x, end.y), (beside, 0.9 - 0.035 * i), arrowprops=leader, **place)


def _groups(rows: Sequence[Row]) -> list[list[Row]]:
    """Steppers that are the same without damping, and whose energy did the same; those with an error to draw."""
    groups: dict[tuple[str, str | None], list[Row]] = {}
    for row in rows:
        if len(row.times) > 1:
            groups.setdefault((row.alike or row.stepper.name, row.measured), []).append(row)
    return list(groups.values())


def _label(group: Sequence[Row]) -> str:
    first, others = group[0], Counter(WORDS.get(row.stepper.kind, row.stepper.kind) for row in group[1:])
    names = [first.stepper.name, *(f"{count} {kind}{'s' if count > 1 else ''}" for kind, count in others.items())]
    predicted = f" (predicted {first.predicted})" if first.predicted not in (None, first.measured) else ""
    return f"{', '.join(names)}: {first.measured or 'not told'}{predicted}"


def _on_constraints(row: Row) -> bool:
    return row.scheme is not None and row.scheme.on_rods


def _largest(times: Array, errors: Array) -> tuple[Array, Array]:
    """The largest error of each span, at the span's end; of the last one, at the last time."""
    span = np.minimum(times / DURATION * SPANS, SPANS - 1).astype(int)
    filled = np.unique(span)
    largest = np.array([np.abs(errors[span == i]).max() for i in filled])
    return np.minimum((filled + 1) * DURATION / SPANS, times[-1]), np.clip(largest, LOWEST, HIGHEST)


def _momentum(axes: Any, rows: Sequence[Row], rounding: float) -> None:
    """Dots for the two momenta, on a line for each stepper."""
    for y, row in enumerate(rows):
        linear, angular = (max(value or 0.0, FLOOR) for value in (row.momentum, row.angular_momentum))
        axes.plot([linear, angular], [y, y], "-", color="#bbbbbb", linewidth=1)
        axes.plot(linear, y, "o", color=COLOURS[6])
        axes.plot(angular, y, "D", color=COLOURS[3], fillstyle="none", markeredgewidth=1.6)
    axes.axvline(rounding, color="#777777", linewidth=1)
    axes.text(rounding, -1.1, " rounding up to here", fontsize=NOTE, color="#555555", va="center")
    axes.set_xscale("log")
    axes.set_xlim(FLOOR / 2, 5)
    from_nothing(axes.xaxis, FLOOR)
    axes.set_ylim(len(rows) - 0.4, -1.8)
    axes.set_yticks(range(len(rows)), [row.stepper.name for row in rows], fontsize=NOTE)
    axes.set_xlabel(
        "largest error [1]: dots, of momentum, as a part of sum m |v|;\n"
        "diamonds, of angular momentum, as a part of that times size"
    )
    axes.set_title("Measured: momentum of a free string", loc="left", fontsize=TITLE)


def _alt(rows: Sequence[Row], free: Sequence[Row]) -> str:
    kinds = "; ".join(
        f"{kind}: {', '.join(row.stepper.name for row in rows if row.measured == kind) or 'none'}" for kind in TRENDS
    )
    momenta = ", ".join(f"{row.stepper.name} {row.momentum:.0e} and {row.angular_momentum:.0e}" for row in free)
    return (
        f"Above: energy errors over time, on a logarithmic axis. {kinds}. Below: what a free string's momentum and "
        f"angular momentum are off: {momenta}."
    )
