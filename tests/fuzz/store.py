"""Stores: values, columns and tables that nobody keeps, files with other bytes, arrays that are gone or broken."""

from __future__ import annotations

import shutil
import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from pathlib import Path
from random import Random
from typing import Any

from experiments.runs.results import rows, write_csv
from experiments.runs.salvage import salvage
from experiments.runs.store import Store
from experiments.runs.stored_rows import COLUMN_TYPES
from reference.errors import InputError
from tests.experiments.runs.tasks import ended, task
from tests.fuzz import wild
from tests.fuzz.doors import Enter

#: Runs of a sound store.
RUNS = 12

#: How answers begin that were encoded.
ANSWERS = [
    "null",
    "{}",
    "[]",
    "1",
    '"x"',
    "{",
    '{"<outcome>": {}}',
    '{"<outcome>": 1}',
    '{"<array>": "answer.trajectory.times"}',
]
ANSWERS += [
    '{"<array>": 1}',
    '{"<array>": []}',
    '{"<limit>": {}}',
    '{"<limit>": 3}',
    '{"<number>": "nan"}',
    '{"a": {"<number>": []}}',
]
ANSWERS += [
    '{"<outcome>": {"ending": "x", "reason": "", "trajectory": null}}',
    "[" * 5000,
    '{"<limit>": {"dt": 1, "factors": 3}}',
]

#: What is done to the whole of it.
STATEMENTS = ["DROP TABLE environments", "DROP INDEX questions", "DELETE FROM environments", "PRAGMA user_version = 9"]
STATEMENTS += [
    "PRAGMA user_version = -1",
    "ALTER TABLE runs RENAME TO walks",
    "CREATE TABLE more (a)",
    "DELETE FROM runs",
]


def make(random: Random) -> Any:
    """What is to be done to a sound store: statements with values; or bytes of its file, or of its arrays."""
    kind = random.randrange(4)
    if kind < 2:
        return "rows", [_change(random) for _ in range(random.randint(1, 3))]
    return ("file", random.randrange(2**32)) if kind == 2 else ("arrays", random.randrange(2**32))


def _change(random: Random) -> tuple[str, list[Any]]:
    column, row = wild.one_of(random, [*COLUMN_TYPES]), random.randint(1, RUNS)
    kind = random.randrange(8)
    if kind == 0:
        return f"ALTER TABLE runs RENAME COLUMN {column} TO other", []
    if kind == 1:
        return wild.one_of(random, STATEMENTS), []
    if kind == 2 or column == "answer":
        return "UPDATE runs SET answer = ? WHERE rowid = ?", [wild.one_of(random, ANSWERS), row]
    found = wild.value(random, depth=0)
    with suppress(AttributeError, UnicodeEncodeError):
        found.encode()  # SQLite takes no lone surrogate
    if isinstance(found, str):
        found = found.encode(errors="replace").decode()
    return f"UPDATE runs SET {column} = ? WHERE rowid = ?", [found, row]


@contextmanager
def opened(folder: Path) -> Iterator[Enter]:
    """A store is read, written to, and taken over."""
    sound = folder / "sound" / "store.sqlite"
    with closing(Store(sound)) as store:
        for number in range(RUNS):
            store.keep(task(number), ended("done") if number % 3 == 0 else {"value": number, "text": "x" * 400}, 0.0)

    def enter(made: Any) -> str:
        shutil.rmtree(folder / "work", ignore_errors=True)
        shutil.copytree(sound.parent, folder / "work")
        file = folder / "work" / "store.sqlite"
        _damage(file, *made)
        refused = [not _goes(lambda: _read(file)), not _goes(lambda: _take_over(file)), not _goes(lambda: _use(file))]
        return "refused" if any(refused) else "taken"

    yield enter


def _damage(file: Path, how: str, what: Any) -> None:
    if how == "rows":
        with closing(sqlite3.connect(file)) as sql, sql:
            for statement, values in what:
                with suppress(sqlite3.Error, OverflowError):
                    sql.execute(statement, values)
        return
    random = Random(what)
    damaged = [file] if how == "file" else random.sample(sorted((file.parent / "arrays").rglob("*.npz")), 2)
    for one in damaged:
        one.write_bytes(wild.damaged(random, one.read_bytes()))


def _goes(do: Any) -> bool:
    """Whether it can be done; refused in one line, it can not."""
    try:
        do()
    except InputError as error:
        if len(str(error).splitlines()) != 1:
            raise RuntimeError(f"more than a line: {error!r}") from None
        return False
    return True


def _read(file: Path) -> None:
    import io

    write_csv(rows(file, {}, retired=True), io.StringIO())


def _take_over(file: Path) -> None:
    new = file.parent / "new" / "store.sqlite"
    kept = salvage(file, new).kept
    assert len(rows(new, {}, retired=True)) == kept


def _use(file: Path) -> None:
    """Every task is found, or done again and kept."""
    with closing(Store(file)) as store:
        for number in range(RUNS):
            if store.find(task(number)) is None:
                store.keep(task(number), number, 0.0)
                found = store.find(task(number))
                assert found is not None, number
                assert found.answer == number
