"""The first figure: how far engines are from the true motion, and from the scheme each is identified as."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from report.figures import COLOURS, IDENTIFIED, MEASURED, NOTE, SMALL, Picture, from_nothing, new_figure

#: Lengths that people know [m].
KNOWN = {1e-3: "1 mm", 1e-6: "1 µm", 1e-10: "an atom", 1e-15: "a proton"}

LOWEST, HIGHEST = 1e-17, 10.0

#: Where no distance at all is drawn [m].
NOTHING = 3e-17

#: Up to here it is rounding [m]: what adding a thousand numbers of the size of 1 m leaves.
ROUNDING = 1e-13


@dataclass(frozen=True)
class Explained:
    """An engine setting: what it was identified as, and how far it is from the true motion and from that scheme [m]."""

    engine: str
    scheme: str | None
    error: float
    deviation: float


def draw(engines: Sequence[Explained]) -> Picture:
    """A row for each engine: a dot at its distance from the true motion, a ring at what its scheme leaves of that."""
    rows = sorted(engines, key=lambda engine: (-engine.error, engine.scheme or ""))
    figure, axes = new_figure(figsize=(9.5, 1.5 + 0.26 * len(rows)))
    axes.axvspan(LOWEST, ROUNDING, color="#efefef", zorder=0, linewidth=0)
    for y, row in enumerate(rows):
        left, error = (max(value, NOTHING) for value in (row.deviation, row.error))
        axes.plot([left, error], [y, y], "-", color="#bbbbbb", linewidth=1.2, zorder=1)
        axes.plot(error, y, color=COLOURS[1], markersize=7, **MEASURED)
        axes.plot(left, y, color=COLOURS[0], markersize=7, **IDENTIFIED)
    axes.set_xscale("log")
    axes.set_xlim(LOWEST, max([HIGHEST, *(3 * row.error for row in rows)]))
    from_nothing(axes.xaxis, NOTHING)
    axes.set_ylim(len(rows) - 0.4, -1.7)
    axes.set_yticks(
        range(len(rows)), [f"{row.engine} = {row.scheme or 'not identified'}" for row in rows], fontsize=NOTE
    )
    axes.tick_params(axis="y", length=0)
    axes.grid(visible=False, axis="y")
    axes.set_xlabel("largest distance of any mass within half a second [m]")
    axes.text(0.7 * ROUNDING, -0.5, "rounding", color="#555555", fontsize=SMALL, ha="right", va="center")
    _words(axes, rows)
    _known_lengths(axes)
    return Picture(figure, _alt(rows))


def _words(axes: Any, rows: Sequence[Explained]) -> None:
    """What dots and rings are, above the first of each."""
    style = {"va": "center", "fontsize": 10, "fontweight": "bold"}
    axes.text(HIGHEST / 3, -1.1, "measured: from the true motion", color=COLOURS[1], ha="right", **style)
    if any(row.scheme for row in rows):
        axes.text(3 * LOWEST, -1.1, "identified: from its scheme", color=COLOURS[0], ha="left", **style)


def _known_lengths(axes: Any) -> None:
    above = axes.secondary_xaxis("top")
    above.set_xticks([*KNOWN], [*KNOWN.values()], fontsize=NOTE)
    above.minorticks_off()
    above.tick_params(length=3)
    above.spines["top"].set_visible(False)


def _alt(rows: Sequence[Explained]) -> str:
    parts = [
        f"{row.engine} {row.error:.1e} m from the true motion and {row.deviation:.1e} m from {row.scheme}"
        if row.scheme
        else f"{row.engine} {row.error:.1e} m from the true motion, not identified"
        for row in rows
    ]
    return f"Distances of engines on a logarithmic axis: {'; '.join(parts)}."
