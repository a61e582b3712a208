"""What is kept stays kept and is found again bit for bit; what is no store of ours is let be."""

from __future__ import annotations

import json
import sqlite3
from contextlib import closing
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from engines.process.isolation import MEMORY_LIMIT, TIME_LIMIT
from experiments.runs import task as task_module
from experiments.runs.results import rows
from experiments.runs.store import FORMAT, Store, StoreError, read_arrays
from reference.outcome import Outcome
from tests.experiments.runs.tasks import alike, arrays_of, ended, endings, kept, task

# --- Keeping and finding ---


def test_what_is_kept_is_found(store: Store, store_file: Path) -> None:
    """Bit for bit, here and by whoever opens the store next; another task is not."""
    store.keep(task(1), ended("done"), 0.5)
    with closing(Store(store_file)) as again:
        for opened in (store, again):
            assert alike(kept(opened, 1), ended("done"))
            assert opened.find(task(2)) is None


def test_an_answer_of_none_is_an_answer(store: Store) -> None:
    """It is not taken for no answer."""
    store.keep(task(1), None, 0.0)
    assert kept(store, 1) is None
    assert store.find(task(1)) is not None


def test_a_row_has_everything_in_columns(store: Store, store_file: Path) -> None:
    """Outcome, reason, limits, environment; arrays in a file by key."""
    store.keep(task(1), {"outcome": ended("diverged", "too fast"), "error_m": 0.1}, 0.25)
    (row,) = rows(store_file, {})
    assert (row["task"], row["outcome"], row["reason"], row["error_m"]) == ("numbered", "diverged", "too fast", 0.1)
    assert (row["key"], row["seconds"]) == (task(1).key, 0.25)
    assert arrays_of(store_file) == [store_file.parent / "arrays" / row["arrays"]]
    assert task(1).key in row["arrays"]
    with closing(sqlite3.connect(store_file)) as sql:
        ((document,),) = sql.execute("SELECT document FROM environments WHERE digest = ?", [row["environment"]])
        assert sql.execute("SELECT time_limit, memory_limit FROM runs").fetchall() == [(TIME_LIMIT, MEMORY_LIMIT)]
    assert json.loads(document)["numpy"] == np.__version__


def test_a_task_is_kept_once(store: Store, store_file: Path) -> None:
    """Where two have done the same at the same time, the first is kept."""
    store.keep(task(1), Outcome("done", "first"), 0.0)
    store.keep(task(1), Outcome("done", "second"), 0.0)
    assert kept(store, 1).reason == "first"
    assert len(rows(store_file, {}, retired=True)) == 1


def test_the_log_is_written_ahead(store: Store, store_file: Path) -> None:
    """The file is in WAL mode, so that those who read do not wait for those who write."""
    with closing(sqlite3.connect(store_file)) as sql:
        assert sql.execute("PRAGMA journal_mode").fetchone() == ("wal",)
        assert sql.execute("PRAGMA user_version").fetchone() == (FORMAT,)


# --- Limits ---


@pytest.mark.parametrize("limit", ["time_limit", "memory_limit"])
@pytest.mark.parametrize(
    ("ending", "again"),
    [("done", False), ("diverged", False), ("unsupported", False), ("timed out", True), ("crashed", True)],
)
def test_only_what_was_stopped_is_run_again_at_other_limits(store: Store, ending: Any, again: bool, limit: str) -> None:
    """At the same limits it is not; at others a run that came to its end is not either."""
    store.keep(task(1), Outcome(ending, "why"), 0.0)
    assert kept(store, 1).ending == ending
    assert (store.find(task(1, **{limit: 7.0})) is None) == again


def test_what_was_stopped_gives_way_to_what_it_was_at_other_limits(store: Store, store_file: Path) -> None:
    """In the results too; the older row stays."""
    store.keep(task(1, time_limit=1.0), Outcome("timed out", "no answer within 1 s"), 1.0)
    store.keep(task(1, time_limit=9.0), Outcome("done"), 2.0)
    assert endings(store_file) == [(1, "done")]
    assert endings(store_file, retired=True) == [(1, "done"), (1, "timed out")]
    assert store.find(task(1, time_limit=1.0)) is not None


# --- Starting over ---


def test_what_is_retired_is_run_again_and_stays(store: Store, store_file: Path) -> None:
    """Rows and arrays of every generation, each as it was."""
    for generation in range(3):
        store.keep(task(1), ended("done", frames=generation + 1), 0.0)
        assert len(kept(store, 1).trajectory) == generation + 1
        store.retire([task(1).key])
        assert store.find(task(1)) is None
    assert endings(store_file) == []
    found = [read_arrays(store_file.parent / "arrays", row["arrays"]) for row in rows(store_file, {}, retired=True)]
    assert sorted(len(arrays["answer.trajectory.times"]) for arrays in found if arrays) == [1, 2, 3]


def test_a_row_with_a_generation_that_is_none_is_followed_by_a_sound_one(store: Store) -> None:
    """A damaged number beyond all is not counted on from (found by `tests.fuzz`)."""
    store.keep(task(1), ended("done"), 0.0)
    with closing(sqlite3.connect(store.file)) as sql, sql:
        sql.execute("UPDATE runs SET generation = 1e146")
    assert store.find(task(1)) is None
    store.keep(task(1), ended("done"), 0.0)
    assert store.find(task(1)) is not None


def test_only_what_is_named_is_retired(store: Store) -> None:
    """Other tasks stay done."""
    for number in range(3):
        store.keep(task(number), number, 0.0)
    store.retire([task(0).key, task(2).key, task(7).key])
    assert [store.find(task(number)) is None for number in range(3)] == [True, False, True]


def test_a_newer_answer_to_the_same_question_takes_the_place_of_an_older_one(
    store: Store, store_file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As after a change of springlab's sources: the key is another one, the question is not."""
    store.keep(task(1), Outcome("done", "by older sources"), 0.0)
    store.keep(task(2), Outcome("done", "by older sources"), 0.0)
    monkeypatch.setattr(task_module, "_sources", lambda task: "newer")
    assert store.find(task(1)) is None
    store.keep(task(1), Outcome("diverged", "by newer sources"), 0.0)
    assert [(row["number"], row["reason"]) for row in rows(store_file, {})] == [
        (2, "by older sources"),
        (1, "by newer sources"),
    ]
    assert len(rows(store_file, {}, retired=True)) == 3


# --- What is no store, or a newer one ---


def refusal(file: Path) -> str:
    """What is said when a store is opened, and the same when it is read; the file is as before."""
    before = file.read_bytes()
    said = []
    for attempt in (lambda: Store(file), lambda: rows(file, {})):
        with pytest.raises(StoreError) as refused:
            attempt()
        said.append(str(refused.value))
    assert file.read_bytes() == before
    assert "\n" not in said[0]
    assert said[0] == said[1]
    assert said[0].startswith(f"store {file}: ")
    return said[0].removeprefix(f"store {file}: ")


def test_a_store_of_a_newer_springlabs_is_let_be(store_file: Path) -> None:
    """It says which format it has found, and which it knows."""
    Store(store_file).close()
    with closing(sqlite3.connect(store_file)) as sql:
        sql.execute(f"PRAGMA user_version = {FORMAT + 1}")
    assert refusal(store_file) == "written by a newer springlab, in format 2; expected 1 or less"


def test_a_file_that_is_no_database_is_let_be(tmp_path: Path) -> None:
    """A text file, say."""
    file = tmp_path / "notes.txt"
    file.write_text("not a database\n" * 100)
    assert refusal(file) == (
        "is damaged, or no store of springlab's (file is not a database); `springlab results --salvage NEW` takes over "
        "what can be read"
    )


def test_a_database_of_another_programs_is_let_be(tmp_path: Path) -> None:
    """Whatever number it has for its own format."""
    for number in (0, 1, 77):
        file = tmp_path / f"places{number}.sqlite"
        with closing(sqlite3.connect(file)) as sql:
            sql.executescript(f"CREATE TABLE bookmarks (address TEXT); PRAGMA user_version = {number};")
        assert refusal(file) == "is no store of springlab's (it has a table 'bookmarks')"


def test_a_store_without_a_place_is_said_in_a_line(tmp_path: Path) -> None:
    """A file where a folder would have to be, a folder where a file would have to be."""
    (tmp_path / "file").write_text("")
    for file in (tmp_path / "file" / "store.sqlite", tmp_path / "file" / "below" / "store.sqlite", tmp_path):
        with pytest.raises(StoreError) as refused:
            Store(file)
        expected = "cannot be written; expected a folder to write in, or another place by --store"
        assert str(refused.value) == f"store {file}: {expected}"
