"""What is in a store, and what is wrong with it."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from experiments.runs.result_codec import decode, encode
from experiments.runs.store import read_arrays
from tests.soak import faults
from tests.soak.sweep import task_of

#: What differs from one time to another.
TIMES = ("seconds", "finished")

Row = Mapping[str, Any]


def rows(store: Path) -> list[Row]:
    """All rows in the order of their keys, without times."""
    with sqlite3.connect(store) as sql:
        sql.row_factory = sqlite3.Row
        found = [dict(row) for row in sql.execute("SELECT * FROM runs ORDER BY key, generation")]
    sql.close()
    return [{name: value for name, value in row.items() if name not in TIMES} for row in found]


def kept_in(store: Path) -> int:
    """How many rows are in a store; none where there is no store yet."""
    if not store.exists():
        return 0
    sql = sqlite3.connect(store)
    try:
        return int(sql.execute("SELECT COUNT(*) FROM runs").fetchone()[0])
    except sqlite3.OperationalError:
        return 0
    finally:
        sql.close()


def arrays(store: Path) -> dict[str, bytes]:
    """The files beside a store by name; without what a killed writer left unfinished, which is never read."""
    folder = store.parent / "arrays"
    return {str(f.relative_to(folder)): f.read_bytes() for f in folder.rglob("*.*") if f.suffix != ".half"}


def check_same(found: Path, wanted: Path) -> None:
    """Two stores are equal, row for row and file for file."""
    check_same_rows(rows(found), rows(wanted))
    check_same_files(arrays(found), arrays(wanted))


def check_same_rows(found: Iterable[Row], wanted: Iterable[Row]) -> None:
    """Rows are equal, each with each."""
    by_key, due = _by_key(found), _by_key(wanted)
    assert not due.keys() - by_key.keys(), f"{len(due.keys() - by_key.keys())} rows are missing"
    assert not by_key.keys() - due.keys(), f"{len(by_key.keys() - due.keys())} rows are too many"
    for key, row in due.items():
        differ = {name: (by_key[key][name], value) for name, value in row.items() if by_key[key][name] != value}
        assert not differ, f"{row['parameters']}: {differ}"


def check_same_files(found: Mapping[str, bytes], wanted: Mapping[str, bytes]) -> None:
    """Files have the same names and bytes."""
    assert found.keys() == wanted.keys()
    assert [name for name in wanted if found[name] != wanted[name]] == []


def _by_key(found: Iterable[Row]) -> dict[tuple[str, int], Row]:
    all_of_them = list(found)
    named = {(row["key"], row["generation"]): row for row in all_of_them}
    assert len(named) == len(all_of_them), "a row is there twice"
    return named


def check_accounted_for(store: Path, numbers: Iterable[int]) -> None:
    """Every run of these numbers has exactly one current row, with what was due of it, bit for bit."""
    check_rows_due([row for row in rows(store) if not row["retired"]], numbers, store.parent / "arrays")


def check_rows_due(found: Iterable[Row], numbers: Iterable[int], folder: Path) -> None:
    """As above, of rows and the folder of their arrays."""
    by_key = {key: row for (key, _), row in _by_key(found).items()}
    due = {task_of(number).key: number for number in numbers}
    assert not due.keys() - by_key.keys(), f"{len(due.keys() - by_key.keys())} runs are lost"
    assert not by_key.keys() - due.keys(), "there are runs that nobody asked for"
    said = {number: (by_key[key]["outcome"], by_key[key]["reason"]) for key, number in due.items()}
    wrong = {number: words for number, words in said.items() if words != faults.due(number)}
    assert not wrong, f"runs with another outcome than is due: {wrong}"
    for key, number in due.items():
        if faults.fault(number) is None:
            check_answer(by_key[key], faults.good_answer(number), folder)


def check_answer(row: Row, answer: Any, folder: Path) -> None:
    """A row's answer, as it is written and as it is read, is that one, bit for bit."""
    document, wanted = encode(answer)
    found = read_arrays(folder, row["arrays"])
    assert found is not None, f"the arrays of {row['parameters']} are gone"
    assert json.loads(row["answer"]) == document
    assert {name: (a.dtype, a.shape, a.tobytes()) for name, a in found.items()} == {
        name: (a.dtype, a.shape, a.tobytes()) for name, a in wanted.items()
    }
    assert encode(decode(json.loads(row["answer"]), found))[0] == document
