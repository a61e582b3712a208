"""What is in a store, for people and other programs: rows, filtered."""

from __future__ import annotations

import csv
import json
from collections.abc import Iterable, Mapping, Sequence
from contextlib import closing
from pathlib import Path
from typing import Any, TextIO

from experiments.runs.progress import Progress
from experiments.runs.result_codec import LIMIT
from experiments.runs.store import StoreError, check_format, in_words, opened_to_read
from experiments.runs.stored_rows import JSON_COLUMNS, TROUBLE, read_rows
from reference.errors import InputError, unknown_name
from reference.files.csv_cell import cell

#: What every row has.
COLUMNS = ("task", "stepper", "version", "dt", "steps", "outcome", "reason")

#: And where one asks for everything.
MORE_COLUMNS = ("settings", "system", "seconds", "finished", "key", "arrays", "environment")

#: What `report` keeps beside the runs it is made of: its sections as they are shown, which are no runs.
SECTIONS = "report_section"


def rows(
    store: Path, filters: Mapping[str, str], retired: bool = False, tell: Progress = lambda _: None
) -> list[dict[str, Any]]:
    """The runs in a store, oldest first, parameters and numbers of the answer as columns of their own.

    Args:
        filters: what columns must be equal to; numbers as numbers.
        retired: whether to show also those that were started over.
        tell: told of each row that is damaged, and left out.

    Raises:
        InputError: if there is no store, the file is not a store, or nothing in it has a column that is asked for.
    """
    found = [_flat(row) for row in _read(store, tell) if retired or not row["retired"]]
    known = {name: None for row in found for name in row}
    for name in filters:
        if found and name not in known:
            raise unknown_name("column", name, known)
    return [row for row in found if all(_equal(row.get(name), value) for name, value in filters.items())]


def parse_filters(words: Iterable[str]) -> dict[str, str]:
    """COLUMN=VALUE as a dictionary."""
    filters = {}
    for word in words:
        name, equals, value = word.partition("=")
        if not (name and equals):
            raise InputError(f"filter {word!r}: expected COLUMN=VALUE")
        filters[name] = value
    return filters


def columns_of(found: Sequence[Mapping[str, Any]]) -> list[str]:
    """A column for everything that any row has: what was run comes first, then how it ended and what was found."""
    before: dict[str, None] = {}
    after: dict[str, None] = {}
    for row in found or [dict.fromkeys((*COLUMNS, *MORE_COLUMNS))]:
        end = [*row].index("outcome")
        before |= dict.fromkeys([*row][:end])
        after |= dict.fromkeys([*row][end:])
    return [*(before | after)]


def write_csv(found: Sequence[Mapping[str, Any]], file: TextIO) -> None:
    """Rows as CSV, with a column for everything that any of them has."""
    columns, writer = columns_of(found), csv.writer(file)
    writer.writerow(map(cell, columns))
    writer.writerows([cell(value) for value in map(row.get, columns)] for row in found)


def _read(store: Path, tell: Progress) -> list[dict[str, Any]]:
    try:
        with closing(opened_to_read(store)) as sql:
            found = read_rows(sql, store.stat().st_size) if check_format(store, sql) else None
    except TROUBLE as error:
        raise StoreError(f"store {store}: {in_words(error)}") from None
    if found is None:
        return []
    for line in found.damaged:
        tell(line)
    return [row for row in found.rows if row["task"] != SECTIONS]


def _flat(row: Mapping[str, Any]) -> dict[str, Any]:
    """A row with what a sweep varied after the stepper, and the answer's numbers and words after the reason."""
    values = dict(row)
    parsed = {name: json.loads(values.pop(name) or "null") for name in JSON_COLUMNS}
    flat = {name: values[name] for name in COLUMNS[:3]} | (parsed["parameters"] or {})
    flat |= {name: values[name] for name in COLUMNS[3:]}
    if isinstance(parsed["answer"], dict):
        taken = {*flat, *values}
        flat |= {f"found_{name}" if name in taken else name: value for name, value in _found(parsed["answer"]).items()}
    flat["settings"] = json.dumps(parsed["settings"])
    return flat | {name: values[name] for name in MORE_COLUMNS[1:]}


def _found(answer: Mapping[str, Any]) -> dict[str, Any]:
    """The numbers and words of an answer, by name; of a limit those that it has."""
    if LIMIT in answer:
        limit = {name: value for name, value in answer[LIMIT].items() if value is not None or name == "dt"}
        factors = limit.pop("factors", ())
        answer = limit | dict(zip(("growth_factor_below", "growth_factor_above"), factors, strict=False))
    return {name: value for name, value in answer.items() if value is None or isinstance(value, str | int | float)}


def _equal(value: Any, wanted: str) -> bool:
    if isinstance(value, int | float) and not isinstance(value, bool):
        try:
            return float(wanted) == value
        except ValueError:
            return False
    return str(value) == wanted if value is not None else wanted in ("", "-")
