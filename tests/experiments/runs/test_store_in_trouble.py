"""Kills, broken files, others at the store: what was kept stays, and one line says what is wrong."""

from __future__ import annotations

import os
import sqlite3
import subprocess
import sys
from contextlib import closing
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from experiments.runs import store as store_module
from experiments.runs.results import rows
from experiments.runs.store import Store, StoreError, read_arrays
from tests.experiments.runs.tasks import alike, arrays_of, ended, endings, kept, task
from tests.reference.systems import property_test
from tests.report.commands.terminal import ROOT, python

# --- Broken files, killed writers ---


def test_a_run_whose_arrays_are_gone_or_broken_is_run_again_and_then_kept(store: Store, store_file: Path) -> None:
    """As after a power failure."""
    for number, damage in enumerate((Path.unlink, empty, cut, overwrite)):
        store.keep(task(number), ended("done"), 0.0)
        damage(store_file.parent / "arrays" / rows(store_file, {"number": str(number)})[0]["arrays"])
        assert store.find(task(number)) is None
        store.keep(task(number), ended("done"), 0.0)
        assert alike(kept(store, number), ended("done"))


def empty(path: Path) -> None:
    """A file of nothing."""
    path.write_bytes(b"")


def cut(path: Path) -> None:
    """Half of a file."""
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])


def overwrite(path: Path) -> None:
    """A page of zeros in the middle."""
    whole = bytearray(path.read_bytes())
    whole[len(whole) // 3 : len(whole) // 2] = bytes(len(whole) // 2 - len(whole) // 3)
    path.write_bytes(whole)


@property_test
@given(st.data())
def test_no_broken_file_is_taken_for_whole(tmp_path_factory: pytest.TempPathFactory, data: st.DataObject) -> None:
    """Wherever one byte of it differs: the same arrays, or none; never others, never an exception."""
    arrays = {"answer.a": np.arange(3.0), "answer.b": np.array([1, 2])}
    folder = tmp_path_factory.mktemp("arrays")
    np.savez(folder / "a.npz", **arrays)  # type: ignore[arg-type]
    whole = (folder / "a.npz").read_bytes()
    place = data.draw(st.integers(0, len(whole) - 1))
    byte = data.draw(st.integers(0, 255))
    (folder / "a.npz").write_bytes(whole[:place] + bytes([byte]) + whole[place + 1 :])
    found = read_arrays(folder, "a.npz", arrays.keys())
    assert found is None or alike(found, arrays)


def test_an_array_that_is_missing_makes_a_file_a_broken_one(tmp_path: Path) -> None:
    """As where a byte of the file's own list of contents is another."""
    np.savez(tmp_path / "a.npz", a=np.arange(3.0))
    assert read_arrays(tmp_path, "a.npz", {"a", "b"}) is None
    assert [*(read_arrays(tmp_path, "a.npz", {"a"}) or {})] == ["a"]


#: Keeps one task, and is killed while it keeps another.
KILLED = """
import os, signal, sys
from pathlib import Path
import numpy as np
from experiments.runs.store import Store
from tests.experiments.runs.tasks import ended, task

def die(*_):
    os.kill(os.getpid(), signal.SIGKILL)

def half(file, **arrays):
    file.write(b"half")
    file.flush()
    die()

store = Store(Path(sys.argv[1]))
store.keep(task(1), ended("done"), 0.0)
moment = sys.argv[2]
if moment == "arrays are written":
    np.savez = half
elif moment == "arrays are put in place":
    Path.replace = die
else:
    store._sql.set_trace_callback(lambda statement: statement.startswith(moment) and die())
store.keep(task(2), ended("done"), 0.0)
"""


@pytest.mark.rotating(3)
@pytest.mark.parametrize(
    "moment",
    ["BEGIN", "arrays are written", "arrays are put in place", "UPDATE runs", "INSERT INTO runs", "COMMIT"],
)
def test_a_kill_at_any_moment_leaves_a_store_that_opens_and_resumes(store_file: Path, moment: str) -> None:
    """What was kept is there, what was not is not, and is kept when it is done again; nothing half is left over."""
    said = python("-c", KILLED, str(store_file), moment, folder=ROOT)
    assert said.code == -9, said.err
    assert endings(store_file) == [(1, "done")]
    with closing(Store(store_file)) as store:
        assert not [*store_file.parent.rglob("*.half")]
        assert alike(kept(store, 1), ended("done"))
        assert store.find(task(2)) is None
        store.keep(task(2), ended("done"), 0.0)
        assert alike(kept(store, 2), ended("done"))
    assert len(arrays_of(store_file)) == 2


def test_what_a_killed_writer_left_is_there_until_the_store_is_opened(store_file: Path) -> None:
    """So that the test above has something to find."""
    python("-c", KILLED, str(store_file), "arrays are written", folder=ROOT)
    assert len([*store_file.parent.rglob("*.half")]) == 1


#: Makes a store and is killed at a statement.
KILLED_EARLY = """
import os, signal, sqlite3, sys
from pathlib import Path
from experiments.runs import store

class Connection(sqlite3.Connection):
    def __init__(self, *words, **more):
        super().__init__(*words, **more)
        self.set_trace_callback(lambda s: sys.argv[2] in s and os.kill(os.getpid(), signal.SIGKILL))

connect = sqlite3.connect
sqlite3.connect = lambda *words, **more: connect(*words, factory=Connection, **more)
store.Store(Path(sys.argv[1]))
"""


@pytest.mark.rotating(3)
@pytest.mark.parametrize(
    "moment", ["user_version", "journal_mode", "environments (", "runs (", "INDEX", "user_version =", "OR IGNORE"]
)
def test_a_kill_while_the_store_is_made_leaves_one_that_opens(store_file: Path, moment: str) -> None:
    """With nothing in it, which is not an error."""
    said = python("-c", KILLED_EARLY, str(store_file), moment, folder=ROOT)
    assert said.code == -9, said.err
    assert rows(store_file, {}) == []
    with closing(Store(store_file)) as store:
        store.keep(task(1), 1, 0.0)
        assert kept(store, 1) == 1


# --- Others at the same store ---


#: Keeps tasks from a number to another, every third with arrays.
WRITER = """
import sys
from pathlib import Path
from experiments.runs.store import Store
from tests.experiments.runs.tasks import ended, task
first, last = map(int, sys.argv[2:])
store = Store(Path(sys.argv[1]))
for number in range(first, last):
    store.keep(task(number), number if number % 3 else ended("done"), 0.0)
"""


def test_two_who_write_at_once_lose_nothing(store_file: Path) -> None:
    """Starting with no store at all; what both have done is there once."""
    known = {**os.environ, "PYTHONPATH": str(ROOT)}
    writers = [
        subprocess.Popen([sys.executable, "-c", WRITER, str(store_file), first, last], env=known, cwd=ROOT)
        for first, last in (("0", "150"), ("100", "250"))
    ]
    assert [writer.wait(600) for writer in writers] == [0, 0]
    assert endings(store_file, retired=True) == [(number, "done") for number in range(250)]
    with closing(Store(store_file)) as store:
        assert all(alike(kept(store, n), n if n % 3 else ended("done")) for n in (0, 1, 99, 120, 200, 249))


def test_many_threads_may_use_a_store(store: Store, store_file: Path) -> None:
    """They wait for one another."""
    from concurrent.futures import ThreadPoolExecutor

    with ThreadPoolExecutor(8) as pool:
        assert all(future is None for future in pool.map(lambda n: store.keep(task(n), ended("done"), 0.0), range(50)))
        assert all(found is not None for found in pool.map(lambda n: store.find(task(n)), range(50)))
    assert len(rows(store_file, {})) == 50


def test_a_store_that_somebody_else_does_not_let_go_of_is_said_in_a_line(
    store_file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """After some patience; reading goes on, and so does writing once it is let go of."""
    monkeypatch.setattr(store_module, "PATIENCE", 0.1)
    with closing(Store(store_file)) as store, closing(sqlite3.connect(store_file, isolation_level=None)) as other:
        store.keep(task(1), 1, 0.0)
        other.execute("BEGIN IMMEDIATE")
        line = (
            f"store {store_file}: another springlab has been writing to it for 0.1 s; run the same command again later"
        )
        for attempt in (lambda: store.keep(task(2), 2, 0.0), lambda: store.retire(["key"]), lambda: Store(store_file)):
            with pytest.raises(StoreError) as refused:
                attempt()
            assert str(refused.value) == line
        assert kept(store, 1) == 1
        assert endings(store_file) == [(1, "done")]
        other.execute("ROLLBACK")
        store.keep(task(2), 2, 0.0)
        assert endings(store_file) == [(1, "done"), (2, "done")]
