"""One damaged row or file costs itself, by name, and never the store; what can be read is taken over by one command."""

from __future__ import annotations

import json
import random
import re
import sqlite3
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path
from typing import Any, cast

import pytest

from experiments.runs.results import rows
from experiments.runs.salvage import _texts, salvage
from experiments.runs.store import Store, StoreError
from experiments.runs.stored_rows import COLUMN_TYPES, LEAST_ROW, _one_by_one
from tests.experiments.runs.tasks import alike, ended, endings, kept, task
from tests.report.commands.terminal import springlab

#: What a column of a row is set to, and what is said of it.
DAMAGES = [
    ("answer", "{", "answer is no JSON"),
    ("answer", "[" * 20_000, "answer is no JSON"),
    ("answer", '{"<limit>": 3}', "answer is no limit"),
    ("answer", '{"<limit>": {"dt": 1, "factors": 3}}', "answer is no limit"),
    ("answer", b"\xff\xfe", "answer is bytes, expected a text"),
    ("parameters", "[1]", "parameters are no names with values"),
    ("parameters", "{'a': 1}", "parameters is no JSON"),
    ("dt", "soon", "dt is a text, expected a number or nothing"),
    ("steps", 1.5, "steps is a number, expected a whole number or nothing"),
    ("retired", "no", "retired is a text, expected a whole number"),
    ("finished", 7.5, ""),  # SQLite keeps it as a text
    ("arrays", "../../etc/passwd", "arrays is no name of a file of arrays"),
    ("reason", b"\x00", "reason is bytes, expected a text"),
]


@pytest.fixture
def three(store: Store, store_file: Path) -> Path:
    """The file of a store with three runs, one with arrays."""
    store.keep(task(0), 0, 0.0)
    store.keep(task(1), ended("done"), 0.0)
    store.keep(task(2), 2, 0.0)
    return store_file


def put(file: Path, statement: str, *values: object) -> None:
    """Change a store behind its back."""
    with closing(sqlite3.connect(file)) as sql, sql:
        sql.execute(statement, values)


@pytest.mark.parametrize(("column", "value", "why"), DAMAGES)
def test_a_damaged_row_costs_itself_and_is_named(three: Path, column: str, value: object, why: str) -> None:
    """The others are shown; asked for again it is run again, and kept; a remark says so."""
    put(three, f"UPDATE runs SET {column} = ? WHERE rowid = 1", value)
    told: list[str] = []
    found = rows(three, {}, tell=told.append)
    assert told == ([f"row 1 is damaged: {why}"] if why else [])
    assert [row["number"] for row in found if row["number"]] == [1, 2]
    with closing(Store(three)) as store:
        assert alike(kept(store, 1), ended("done"))
        if why:
            assert store.find(task(0)) is None
            assert store.remarks == [f"store {three}: the run {task(0).key[:12]} is damaged ({why}), and is run again"]
            store.keep(task(0), 0, 0.0)
        assert kept(store, 0) == 0


@pytest.mark.parametrize(
    "answer", ['{"<outcome>": 1}', '{"<limit>": {"no": 1}}', '{"<array>": []}', '{"<number>": "x"}']
)
def test_an_answer_that_nobody_gave_is_run_again(three: Path, answer: str) -> None:
    """It is JSON, and none that was encoded here; where it is a limit's, the row itself is one that is damaged."""
    put(three, "UPDATE runs SET answer = ? WHERE rowid = 1", answer)
    with closing(Store(three)) as store:
        assert store.find(task(0)) is None
        assert re.search(r"is damaged \((its answer is none|answer is no limit)\), and is run again", store.remarks[0])
    rows(three, {})


def test_the_command_shows_the_others_and_says_what_to_do(three: Path) -> None:
    """Exit code 0: the store is not lost."""
    put(three, "UPDATE runs SET answer = '{' WHERE rowid = 2")
    said = springlab("results", "--json", "--store", str(three))
    assert said.code == 0
    assert [row["number"] for row in json.loads(said.out)] == [0, 2]
    assert said.err.splitlines() == [
        f"store {three}: row 2 is damaged: answer is no JSON",
        f"store {three}: 1 rows are damaged and left out; the others are here, and `springlab results --salvage NEW` "
        "takes them over",
    ]


@pytest.mark.rotating(3)
@pytest.mark.parametrize("column", COLUMN_TYPES)
def test_a_store_without_a_column_is_one_line(three: Path, column: str) -> None:
    """For reading and for writing; with what to do, which does it where the column is one that can be left out."""
    others = ", ".join(name for name in COLUMN_TYPES if name != column)
    put(three, f"CREATE TABLE others AS SELECT {others} FROM runs")
    put(three, "DROP TABLE runs")
    put(three, "ALTER TABLE others RENAME TO runs")
    line = (
        f"store {three}: its runs have no column {column!r}; `springlab results --salvage NEW` takes over what can be "
    )
    for attempt in (lambda: Store(three), lambda: rows(three, {})):
        with pytest.raises(StoreError) as refused:
            attempt()
        assert str(refused.value) == line + "read"
    new = three.parent / "new" / "store.sqlite"
    if column in ("key", "task", "outcome", "answer"):
        with pytest.raises(StoreError, match=f"nothing can be taken over, as there is no column '{column}'"):
            salvage(three, new)
    else:
        assert salvage(three, new).kept == 3
        assert len(rows(new, {})) == 3


def test_salvage_takes_over_what_is_whole_with_its_arrays(three: Path) -> None:
    """And names what is not; the old store is as it was; the new one goes on."""
    put(three, "UPDATE runs SET answer = '{' WHERE rowid = 1")
    before, new = three.read_bytes(), three.parent / "new" / "store.sqlite"
    said = springlab("results", "--salvage", str(new), "--store", str(three))
    assert (said.code, said.out) == (0, "")
    assert said.err.splitlines() == [
        f"2 runs are in {new}; 1 rows and 0 files of arrays are lost",
        "lost: row 1 is damaged: answer is no JSON",
    ]
    assert three.read_bytes() == before
    assert endings(new) == [(1, "done"), (2, "done")]
    with closing(Store(new)) as store:
        assert alike(kept(store, 1), ended("done"))
        assert store.find(task(0)) is None
        store.keep(task(0), 0, 0.0)
        assert kept(store, 0) == 0


def test_salvage_names_broken_arrays_and_their_run_is_run_again(three: Path) -> None:
    """Its row is kept, with its numbers."""
    (file,) = (three.parent / "arrays").rglob("*.npz")
    file.write_bytes(b"PK")
    new = three.parent / "new" / "store.sqlite"
    found = salvage(three, new)
    assert (found.kept, found.lost) == (3, [])
    assert found.arrays_lost == [str(file.relative_to(three.parent / "arrays"))]
    with closing(Store(new)) as store:
        assert store.find(task(1)) is None


def test_salvage_writes_over_nothing(three: Path) -> None:
    """Not over a store, nor into the folder whose arrays are the old one's."""
    for new, why in (
        (three, "is there already"),
        (three.parent / "new.sqlite", "expected another folder than that of"),
    ):
        with pytest.raises(StoreError, match=why):
            salvage(three, new)
    with pytest.raises(StoreError, match="there is none"):
        salvage(three.parent / "none.sqlite", three.parent / "new" / "store.sqlite")


def test_of_a_file_with_damaged_pages_the_other_rows_are_read(store: Store, store_file: Path) -> None:
    """Three hundred times some bytes of it are others: rows are read, or one line says why not; never anything else."""
    for number in range(30):
        store.keep(task(number), {"value": number, "text": "x" * 500}, 0.0)
    store.close()
    whole, part, refused = store_file.read_bytes(), 0, 0
    for seed in range(300):
        rng = random.Random(seed)
        damaged = bytearray(whole)
        for _ in range(rng.choice((1, 4, 64))):
            damaged[rng.randrange(len(damaged))] = rng.randrange(256)
        file = store_file.parent / f"{seed}" / "store.sqlite"
        file.parent.mkdir()
        file.write_bytes(bytes(damaged))
        try:
            part += len(rows(file, {})) < 30
        except StoreError:
            refused += 1
    assert part > 10
    assert refused < 100


def test_a_page_of_zeros_costs_the_rows_that_are_in_it(store: Store, store_file: Path) -> None:
    """They are named by their numbers; the others are there, also in a new store."""
    for number in range(60):
        store.keep(task(number), {"value": number, "text": "x" * 500}, 0.0)
    store.close()
    whole = bytearray(store_file.read_bytes())
    size = int.from_bytes(whole[16:18], "big")
    leaves = [at for at in range(size, len(whole), size) if whole[at] == 13 and b"xxxx" in whole[at : at + size]]
    whole[leaves[1] : leaves[1] + size] = bytes(size)
    store_file.write_bytes(bytes(whole))
    told: list[str] = []
    found = rows(store_file, {}, tell=told.append)
    assert 40 < len(found) < 60
    assert len(told) == 60 - len(found)
    assert all("cannot be read: " in line for line in told)
    new = store_file.parent / "new" / "store.sqlite"
    assert salvage(store_file, new).kept == len(found)
    assert len(rows(new, {})) == len(found)


def test_salvage_takes_over_environments_that_are_words() -> None:
    """A digest and a document, both texts that can be shown."""
    rows_found: list[Any] = [("a1", "{}"), ("a1", 3), (3, "{}"), ("a1", b"{}"), ("a\x00", "{}"), ("a1", "{\x07}")]
    assert [_texts(row) for row in rows_found] == [True, False, False, False, False, False]


def test_salvage_goes_on_in_folders_that_are_there(three: Path) -> None:
    """As those of arrays are, from the second on that begins with the same letters."""
    (file,) = (three.parent / "arrays").rglob("*.npz")
    new = three.parent / "new" / "store.sqlite"
    (new.parent / file.relative_to(three.parent)).parent.mkdir(parents=True)
    assert salvage(three, new).kept == 3
    assert (new.parent / file.relative_to(three.parent)).read_bytes() == file.read_bytes()


@pytest.mark.parametrize(("last", "asked"), [(10**15, 10), (4, 4), (None, 0)])
def test_no_more_rows_are_looked_for_than_a_file_can_have(last: int | None, asked: int) -> None:
    """Nor than there are, one by one: a number of a damaged file may be anything."""
    places: list[int] = []

    class Sql:
        def execute(self, _: str, place: Sequence[int] = ()) -> Sql:
            places.extend(place)
            return self

        def fetchone(self) -> tuple[int | None]:
            return (last,)

    list(_one_by_one(cast(sqlite3.Connection, Sql()), 10 * LEAST_ROW, []))
    assert places == [*range(1, asked + 1)]
