"""Predicted against measured stability limits, a row of panels, one for each case of damping and drag."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from experiments.experiment import Result
from experiments.limits.limit_rows import Row
from report.figures import COLOURS, MEASURED, PREDICTED, SMALL, TITLE, Picture, new_figure


def draw(result: Result) -> Picture:
    """Every stepper's limit in every case: a black bar where it is predicted, a dot where it is measured."""
    rows: Sequence[Row] = result.data["rows"]
    cases = list(dict.fromkeys(_case(row) for row in rows))
    names = list(dict.fromkeys(row.stepper for row in rows))
    figure, panels = new_figure(
        ncols=len(cases), sharex=True, sharey=True, figsize=(11, 1.4 + 0.26 * len(names)), squeeze=False
    )
    for panel, case in zip(panels.flat, cases, strict=True):
        _panel(panel, case, [row for row in rows if _case(row) == case], names)
    figure.suptitle("largest stable dt: predicted (bar) and measured (dot)", x=0.01, ha="left", fontsize=TITLE)
    return Picture(figure, _alt(rows))


def _panel(axes: Any, case: str, rows: Sequence[Row], names: Sequence[str]) -> None:
    from matplotlib.ticker import NullFormatter

    for row in rows:
        y = names.index(row.stepper)
        if row.predicted.dt is not None:
            axes.plot([row.predicted.dt] * 2, [y - 0.4, y + 0.4], linewidth=2, **PREDICTED)
        if row.predicted.dt is not None and row.predicted.at_most is not None:
            axes.plot([row.predicted.at_most] * 2, [y - 0.4, y + 0.4], linewidth=2, **PREDICTED)
            axes.plot([row.predicted.dt, row.predicted.at_most], [y, y], linewidth=1, **PREDICTED)
        if row.measured.dt is not None:
            axes.plot(row.measured.dt, y, color=COLOURS[1], **MEASURED)
        if row.measured.dt is None:
            beside = {"va": "center", "fontsize": SMALL, "color": "#555555"}
            if row.predicted.dt is not None:
                axes.text(1.2 * row.predicted.dt, y, _measured(row), **beside)
            else:
                word = next(
                    (w for w in ("unstable", "stable") if row.predicted.reason.startswith(f"{w} at any dt")), ""
                )
                word = f"{word} at any dt" if word else _measured(row)
                axes.text(0.02, y, word, transform=axes.get_yaxis_transform(), **beside)
    axes.set_yticks(range(len(names)), names)
    axes.set_ylim(len(names) - 0.5, -0.5)
    axes.set_xscale("log")
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.set_title(case, fontsize=TITLE, loc="left")
    axes.set_xlabel("dt [s]")


def _measured(row: Row) -> str:
    """Why there is no measured limit, in a few words."""
    if row.outcome != "done":
        return row.outcome
    for word in ("unstable", "stable"):
        if row.measured.reason.startswith((f"{word} at any dt", f"{word} at all of")):
            return f"{word} at any dt tried"
    return "not measured"


def _case(row: Row) -> str:
    damping, drag = float(np.max(row.system.damping, initial=0.0)), row.system.drag
    parts = [f"{name} {value:g} N s/m" for name, value in (("damping", damping), ("drag", drag)) if value]
    return ", ".join(parts) or "undamped"


def _alt(rows: Sequence[Row]) -> str:
    compared = [abs(row.relative_difference) for row in rows if row.relative_difference is not None]
    if not compared:
        return "No limit was both predicted and measured."
    return (
        f"Bars and dots for {len(compared)} stability limits, predicted and measured; the widest apart differ by "
        f"{max(compared):.1e} of the limit."
    )
