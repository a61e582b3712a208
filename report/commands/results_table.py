"""What of a store's rows is shown in a terminal: what differs between them, as much as there is room for."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from experiments.runs.results import MORE_COLUMNS, columns_of
from reference.system import PARAMETERS
from report.plain import plain

#: Columns that are called otherwise by `springlab compare`.
HEADINGS = {
    "dt": "dt [s]",
    "error_m": "error [m]",
    "identified_as": "identified as",
    "identification_error_m": "deviation [m]",
    "ties": "ties with",
    "told_apart_by": "told apart by",
    "compared_by": "compared by",
    "why_not_identified": "why not identified",
}

#: What is left out first where there is no room, and what never is.
LEAST, MOST = ("version", "task", "steps"), ("stepper", "outcome")

#: Texts of SENTENCE characters and more are folded, to FOLDED characters at least.
SENTENCE, FOLDED = 40, 16


def heading(column: str) -> str:
    """A column's name with its unit."""
    if column in PARAMETERS:
        return f"{column} [{PARAMETERS[column].partition(',')[0]}]"
    return HEADINGS.get(column, column)


def for_people(rows: Sequence[Mapping[str, Any]], width: int) -> tuple[list[str], dict[str, Any], list[str]]:
    """The columns to show; what is the same in every row; and what there is no room for. Args: width: [characters]."""
    columns = [name for name in columns_of(rows) if name not in MORE_COLUMNS]
    values = {name: [row.get(name) for row in rows] for name in columns}
    values = {name: found for name, found in values.items() if any(value not in (None, "") for value in found)}
    same = {name: found[0] for name, found in values.items() if len(rows) > 1 and all(v == found[0] for v in found)}
    shown = sorted((name for name in values if name not in same), key=lambda name: name == "reason")
    left_out: list[str] = []
    for name in [*LEAST, *reversed(columns)]:
        if sum(_width(n, values[n]) for n in shown) <= width:
            break
        if name in shown and name not in MOST:
            shown.remove(name)
            left_out.append(name)
    return shown, same, left_out


def _width(name: str, values: Sequence[Any]) -> int:
    """Of a column, with the space beside it."""
    longest = max(len(plain(value)) for value in values)
    return max(len(heading(name)), longest if longest < SENTENCE else FOLDED) + 3
