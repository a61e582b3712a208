"""What changed from version to version: a table of words and numbers, each change marked."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import wrap
from typing import Any

from experiments.engine_versions.changes import same
from experiments.engine_versions.conformance import Value
from experiments.engine_versions.versions import VersionMeasurements
from experiments.experiment import Result
from report.figures import COLOURS, NOTE, Picture, new_figure

#: Letters in a line of a cell and lines in a cell, at most; inches for a line, a version's column, the names' column.
LETTERS, LINES = 34, 3
LINE, COLUMN, NAMES = 0.19, 2.7, 3.9

#: What a changed cell has beside its colour.
MARK = "\N{BLACK RIGHT-POINTING TRIANGLE} "


def draw(result: Result) -> Picture:
    """A row for each engine and measure that differs, a column for each version; a change in bold and marked."""
    measured: VersionMeasurements = result.data["measured"]
    versions, rows = [*measured.rows], result.tables[0].rows
    cells = [[f"{row[0]}\n{row[1]}", *(_words(value) for value in row[2:])] for row in rows]
    heights = [max(cell.count("\n") + 1 for cell in row) + 0.7 for row in cells]
    total = 2.5 + sum(heights)
    figure, axes = new_figure(figsize=(NAMES + COLUMN * len(versions), LINE * total))
    axes.set_axis_off()
    axes.set_xlim(0, NAMES + COLUMN * len(versions))
    axes.set_ylim(total, 0)
    _heading(axes, measured.package, versions, bool(rows))
    top = 2.0
    for row, words, height in zip(rows, cells, heights, strict=True):
        axes.axhline(top, color="#dddddd", linewidth=0.8)
        axes.text(0.05, top + height / 2, words[0], va="center", fontsize=NOTE)
        for i, text in enumerate(words[1:]):
            _cell(axes, NAMES + COLUMN * i, top, height, text, _changed(row[2:], i))
        top += height
    return Picture(figure, _alt(measured.package, versions, rows))


def _heading(axes: Any, package: str, versions: Sequence[str], some: bool) -> None:
    axes.text(0.05, 1, package if some else f"{package}: no difference", va="center", fontweight="bold")
    for i, version in enumerate(versions):
        axes.text(NAMES + COLUMN * i + 0.08, 1, version, va="center", fontweight="bold")


def _cell(axes: Any, left: float, top: float, height: float, text: str, changed: bool) -> None:
    from matplotlib.patches import Rectangle

    if changed:
        axes.add_patch(Rectangle((left, top), COLUMN - 0.06, height, color=COLOURS[4], alpha=0.3, linewidth=0))
    weight, mark = ("bold", MARK) if changed else ("normal", "")
    axes.text(left + 0.08, top + height / 2, mark + text, va="center", fontsize=8.5, fontweight=weight)


def _changed(values: Sequence[Value | None], i: int) -> bool:
    """Whether the i-th of a row's values is not that of the version before."""
    return i > 0 and None not in (values[i - 1], values[i]) and not same(values[i - 1], values[i])


def _words(value: Value | None, letters: int = LETTERS, lines: int = LINES) -> str:
    if value is None:
        return "not asked"
    text = f"{value:.7g}" if isinstance(value, float) else value
    return "\n".join(wrap(text, letters, max_lines=lines, placeholder=" ..."))


def _alt(package: str, versions: Sequence[str], rows: Sequence[Sequence[Any]]) -> str:
    if not rows:
        return f"No measurement of {package} differs between {', '.join(versions)}."
    told = [
        f"{row[0]}, {row[1]}: "
        + ", ".join(f"{_words(value, 60, 1)} in {version}" for version, value in zip(versions, row[2:], strict=True))
        for row in rows[:3]
    ]
    more = f"; and {len(rows) - 3} more" if len(rows) > 3 else ""
    return f"A table of what differs between versions of {package}. {'; '.join(told)}{more}."
