"""The rows of a store as they are found: each is whole, or damaged, which is then said of it and costs nothing else."""

from __future__ import annotations

import json
import re
import sqlite3
from collections.abc import Iterator, Mapping
from types import MappingProxyType
from typing import Any, NamedTuple

from experiments.runs.result_codec import LIMIT, decode

#: What each column of a run holds; REAL columns hold floats, and where there may be nothing, None.
COLUMN_TYPES: Mapping[str, tuple[type, ...]] = {
    "key": (str,),
    "generation": (int,),
    "question": (str,),
    "retired": (int,),
    "task": (str,),
    "stepper": (str, type(None)),
    "version": (str, type(None)),
    "settings": (str, type(None)),
    "system": (str, type(None)),
    "parameters": (str, type(None)),
    "dt": (float, type(None)),
    "steps": (int, type(None)),
    "outcome": (str,),
    "reason": (str,),
    "answer": (str,),
    "arrays": (str, type(None)),
    "time_limit": (float,),
    "memory_limit": (float,),
    "seconds": (float,),
    "finished": (str,),
    "environment": (str,),
}

#: What SQLite raises for a damaged file, in whose words there may be bytes of it that are no text.
TROUBLE = (sqlite3.DatabaseError, UnicodeError)

#: Columns that hold JSON.
JSON_COLUMNS = ("settings", "parameters", "answer")

#: A file of arrays, from their folder.
ARRAYS_FILE = re.compile(r"([\w-]{1,8}/)?[\w-][\w.-]{0,200}\.npz")

#: The least that a row takes of a file [bytes]: there are no more of them in one than that makes.
LEAST_ROW = 60


class Found(NamedTuple):
    """The rows that are whole, the oldest first, and a line for each that is not."""

    rows: list[dict[str, Any]]
    damaged: list[str]


def as_text(raw: bytes) -> str:
    """A text of SQLite's; what is no UTF-8 in it stays to be seen, by `damage`."""
    return raw.decode("utf-8", "surrogateescape")


def read_rows(sql: sqlite3.Connection, size: int, missing: Mapping[str, Any] = MappingProxyType({})) -> Found:
    """All rows of a store's table, as many as can be read.

    Args:
        sql: with rows by name.
        size: of the file [bytes].
        missing: what stands for columns that there are not.
    """
    sql.text_factory = as_text
    found = Found([], [])
    try:
        _sort_in(found, iter(sql.execute("SELECT rowid AS place, * FROM runs").fetchall()), missing)
    except TROUBLE:
        found.rows.clear()
        found.damaged.clear()
        _sort_in(found, _one_by_one(sql, size, found.damaged), missing)
    found.rows.sort(key=lambda row: row["finished"])
    return found


def _sort_in(found: Found, rows: Iterator[sqlite3.Row], missing: Mapping[str, Any]) -> None:
    for row in rows:
        values = {**missing, **dict(row)}
        place = values.pop("place")
        if why := damage(values):
            found.damaged.append(f"row {place} is damaged: {why}")
        else:
            found.rows.append(values)


def _one_by_one(sql: sqlite3.Connection, size: int, damaged: list[str]) -> Iterator[sqlite3.Row]:
    """Rows by their numbers, where they cannot be read all at once."""
    most = size // LEAST_ROW
    try:
        (last,) = sql.execute("SELECT max(rowid) FROM runs").fetchone()
    except TROUBLE:
        last = most
    for place in range(1, min(last or 0, most) + 1):
        try:
            row = sql.execute("SELECT rowid AS place, * FROM runs WHERE rowid = ?", [place]).fetchone()
        except TROUBLE as error:
            damaged.append(f"row {place} cannot be read: {error}")
            continue
        if row is not None:
            yield row


def damage(row: Mapping[str, Any]) -> str:
    """What is wrong with a row, in words; nothing where it is whole."""
    for name, kinds in COLUMN_TYPES.items():
        value = row[name]
        if not isinstance(value, kinds):
            return f"{name} is {_kind(value)}, expected {' or '.join(map(_name, kinds))}"
        if isinstance(value, str) and not _is_text(value):
            return f"{name} is no UTF-8"
    for name in JSON_COLUMNS:
        try:
            document = json.loads(row[name] or "null")
        except (ValueError, RecursionError):
            return f"{name} is no JSON"
        if name == "parameters" and not isinstance(document, dict | None):
            return "parameters are no names with values"
        if name == "answer" and isinstance(document, dict) and LIMIT in document and not _is_limit(document):
            return "answer is no limit"
    if row["arrays"] is not None and not ARRAYS_FILE.fullmatch(row["arrays"]):
        return "arrays is no name of a file of arrays"
    return ""


def _is_limit(document: dict[str, Any]) -> bool:
    """Whether it is a limit that was encoded: its factors, where it has some, are a list."""
    try:
        decode(document, {})
    except (TypeError, AttributeError, KeyError, ValueError):
        return False
    return isinstance(document[LIMIT].get("factors"), list | None)


def _is_text(value: str) -> bool:
    try:
        value.encode()
    except UnicodeEncodeError:
        return False
    return True


def _kind(value: Any) -> str:
    return _name(type(value))


def _name(kind: type) -> str:
    return {str: "a text", int: "a whole number", float: "a number", bytes: "bytes"}.get(kind, "nothing")
