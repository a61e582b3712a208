"""What can still be read of a damaged store, or of one with other columns, taken over into a new one."""

from __future__ import annotations

import shutil
import sqlite3
from collections.abc import Iterator, Mapping
from contextlib import closing, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from experiments.runs.store import Store, StoreError, opened_to_read, read_arrays
from experiments.runs.stored_rows import COLUMN_TYPES, TROUBLE, as_text, read_rows

#: What stands for a column that a store does not have; without the others a row says nothing.
DEFAULTS: Mapping[str, Any] = {
    "generation": 0,
    "question": "",
    "retired": 0,
    "stepper": None,
    "version": None,
    "settings": "null",
    "system": None,
    "parameters": "null",
    "dt": None,
    "steps": None,
    "reason": "",
    "arrays": None,
    "time_limit": 0.0,
    "memory_limit": 0.0,
    "seconds": 0.0,
    "finished": "",
    "environment": "",
}


@dataclass
class Salvaged:
    """What became of a store's rows.

    Attributes:
        kept: how many are in the new store.
        lost: a line for each row that is not.
        arrays_lost: files of arrays that are gone or broken; their rows are kept, and run again when they are needed.
    """

    kept: int = 0
    lost: list[str] = field(default_factory=list)
    arrays_lost: list[str] = field(default_factory=list)


def salvage(old: Path, new: Path) -> Salvaged:
    """Take over what can be read of a store into a new one; the old one is not changed.

    Raises:
        StoreError: where there is no old one, nothing of it can be read, or there is a new one already.
    """
    if new.exists():
        raise StoreError(f"store {new}: is there already; expected the name of a new one")
    if new.resolve().parent == old.resolve().parent:
        raise StoreError(f"store {new}: expected another folder than that of {old}, as arrays go beside it")
    found = Salvaged()
    with closing(opened_to_read(old)) as source:
        rows, environments = _rows(old, source, found), _environments(source)
    with closing(Store(new)), closing(sqlite3.connect(new)) as target, target:
        target.executemany("INSERT OR IGNORE INTO environments VALUES (?, ?)", environments)
        for row in rows:
            _take_over(row, target, old.parent / "arrays", new.parent / "arrays", found)
    return found


def _rows(old: Path, source: sqlite3.Connection, found: Salvaged) -> list[dict[str, Any]]:
    """The whole rows, with the defaults of columns that are missing."""
    try:
        columns = {name for (_, name, *_) in source.execute("PRAGMA table_info(runs)")}
        for name in COLUMN_TYPES.keys() - DEFAULTS.keys() - columns:
            raise StoreError(f"store {old}: nothing can be taken over, as there is no column {name!r}")
        missing = {name: DEFAULTS[name] for name in COLUMN_TYPES.keys() - columns}
        rows, found.lost = read_rows(source, old.stat().st_size, missing)
    except TROUBLE as error:
        raise StoreError(f"store {old}: nothing of it can be read ({error})") from None
    return rows


def _environments(source: sqlite3.Connection) -> list[tuple[str, str]]:
    source.text_factory = as_text
    with suppress(*TROUBLE):
        return [tuple(row) for row in source.execute("SELECT digest, document FROM environments") if _texts(row)]
    return []


def _texts(row: sqlite3.Row) -> bool:
    return all(isinstance(value, str) and value.isprintable() for value in row)


def _take_over(row: Mapping[str, Any], target: sqlite3.Connection, old: Path, new: Path, found: Salvaged) -> None:
    """A row into the new store, with its arrays."""
    names = ", ".join(COLUMN_TYPES)
    values = [row[name] for name in COLUMN_TYPES]
    places = ", ".join("?" * len(values))
    if target.execute(f"INSERT OR IGNORE INTO runs ({names}) VALUES ({places})", values).rowcount == 0:
        found.lost.append(f"run {row['key'][:12]}, generation {row['generation']}: there are two of it")
        return
    found.kept += 1
    path = row["arrays"]
    if path is None:
        return
    if read_arrays(old, path) is None:
        found.arrays_lost.append(path)
        return
    (new / path).parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(old / path, new / path)


def lines(found: Salvaged, new: Path, most: int = 10) -> Iterator[str]:
    """What is told of it: how many were kept, and by name what was lost, the first ones of many."""
    lost_arrays = len(found.arrays_lost)
    yield f"{found.kept} runs are in {new}; {len(found.lost)} rows and {lost_arrays} files of arrays are lost"
    for what, lost in (("", found.lost), ("arrays ", found.arrays_lost)):
        yield from (f"lost: {what}{line}" for line in lost[:most])
        if len(lost) > most:
            yield f"lost: {what}{len(lost) - most} more"
