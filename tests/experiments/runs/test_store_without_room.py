"""No room for a store, or no place to write in: what was kept stays, and one line says what is wrong."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest

from experiments.runs.store import Store, StoreError
from tests.experiments.runs.tasks import alike, arrays_of, ended, endings, kept, task
from tests.report.commands.terminal import ROOT, python

# --- No room ---


FULL = "the disk is full; what was kept is safe: make room, and run the same command again"


def test_a_full_disk_under_the_table_is_said_in_a_line(store: Store, store_file: Path) -> None:
    """SQLite's own "database or disk is full": with arrays or without, what was kept is there, and it goes on."""
    store.keep(task(1), ended("done"), 0.0)
    (pages,) = store._sql.execute("PRAGMA page_count").fetchone()
    store._sql.execute(f"PRAGMA max_page_count = {pages}")
    for answer in ("word " * 10_000, [ended("done"), "word " * 10_000]):
        with pytest.raises(StoreError) as refused:
            store.keep(task(2), answer, 0.0)
        assert str(refused.value) == f"store {store_file}: {FULL}"
        assert endings(store_file) == [(1, "done")]
        assert alike(kept(store, 1), ended("done"))
        assert store.find(task(2)) is None
    store._sql.execute("PRAGMA max_page_count = 1000000")
    store.keep(task(2), answer, 0.0)
    assert alike(kept(store, 2), answer)


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full here")
def test_a_full_disk_under_the_arrays_is_said_in_a_line(store: Store, store_file: Path) -> None:
    """The system's own ENOSPC: no row without its arrays, nothing half left over, and it goes on."""
    store.keep(task(1), ended("done"), 0.0)
    (store_file.parent / "arrays" / f"{task(2).key}-0.half").symlink_to("/dev/full")
    with pytest.raises(StoreError) as refused:
        store.keep(task(2), ended("done"), 0.0)
    assert str(refused.value) == f"store {store_file}: {FULL}"
    assert endings(store_file) == [(1, "done")]
    assert len(arrays_of(store_file)) == 1
    store.keep(task(2), ended("done"), 0.0)
    assert alike(kept(store, 2), ended("done"))


#: In a file system of its own: sweeps until it is full; then there is room, and the same command is given again.
SWEPT = """
import json, subprocess, sys
from pathlib import Path
from tests.report.commands.terminal import springlab
folder = sys.argv[1]
words = ("sweep", "--stepper", "heun", "--over", "stiffness=100:200:40", "--duration", "0.1", "--keep", "--json")
store = ("--store", f"{folder}/store.sqlite")
full = springlab(*words, *store, "--jobs", "1")
left = springlab("results", "--json", *store)
halves = [str(half) for half in Path(folder).rglob("*.half")]
subprocess.run(["mount", "-o", "remount,size=64m", folder], check=True)
then = springlab(*words, *store, "--jobs", "1")
print(json.dumps([full.code, full.err, json.loads(left.out), halves, then.code, then.err, json.loads(then.out)]))
"""


@pytest.mark.rotating(3)
def test_a_sweep_that_fills_a_disk_goes_on_when_there_is_room(tmp_path: Path) -> None:
    """On a real file system of 600 kB, where this machine lets one be mounted, out of everybody else's sight."""
    mount = ["unshare", "--mount", "sh", "-c", 'mount -t tmpfs -o size=600k none "$0" && exec "$@"', str(tmp_path)]
    if shutil.which("unshare") is None or subprocess.run([*mount, "true"], capture_output=True).returncode:
        pytest.skip("no file system can be mounted here")
    known = {**os.environ, "PYTHONPATH": str(ROOT)}
    child = [*mount, sys.executable, "-c", SWEPT, str(tmp_path)]
    said = subprocess.run(child, capture_output=True, text=True, cwd=ROOT, env=known)
    assert said.returncode == 0, said.stderr
    code, line, left, halves, then_code, then_line, then = json.loads(said.stdout)
    assert (code, line) == (2, f"springlab: store {tmp_path}/store.sqlite: {FULL}\n")
    assert 0 < len(left) < 40
    assert halves == []
    assert (then_code, then_line, then["runs"], then["run_now"]) == (0, "", 40, 40 - len(left))


# --- Nowhere to write ---


#: As somebody who may not write everywhere, calls `springlab WORDS`.
NOBODY = """
import os, sys
from experiments.runs import results
from report.commands import results_table
from experiments.runs import store
from report.commands import sweep as sweep_commands
from experiments.runs import sweeps
from experiments.runs.runner import LocalExecutor
from experiments.runs.steppers import all_steppers
from tests.report.commands.terminal import springlab
all_steppers()
springlab("sweep", "--help")
found = store.environment()
store.environment = lambda: dict(found)
if os.getuid() == 0:
    os.setgid(65534)
    os.setuid(65534)
said = springlab(*sys.argv[1:])
print(said.out, end="")
print(said.err, end="", file=sys.stderr)
sys.exit(said.code)
"""


@pytest.fixture
def read_only() -> Iterator[Path]:
    """A folder with a store that has one run; all may look into it, none but the superuser may write."""
    folder = Path(tempfile.mkdtemp(prefix="springlab-test-"))
    with closing(Store(folder / "store.sqlite")) as store:
        store.keep(task(1), ended("done"), 0.0)
    folder.chmod(0o555)
    (folder / "store.sqlite").chmod(0o444)
    yield folder
    folder.chmod(0o755)
    shutil.rmtree(folder)


@pytest.mark.rotating(7, in_turn=True)
@pytest.mark.parametrize("name", ["store.sqlite", "new.sqlite", "below/store.sqlite"])
def test_a_folder_that_cannot_be_written_is_said_in_a_line(read_only: Path, name: str) -> None:
    """Whether there is a store in it or not; exit code 2, and nothing has been run."""
    words = ("sweep", "--stepper", "heun", "--over", "masses=3,4", "--store", str(read_only / name))
    said = python("-c", NOBODY, *words, folder=ROOT)
    expected = "cannot be written; expected a folder to write in, or another place by --store"
    assert (said.code, said.out, said.err) == (2, "", f"springlab: store {read_only / name}: {expected}\n")


@pytest.mark.rotating(4, in_turn=True)
def test_a_store_that_cannot_be_written_can_be_read(read_only: Path) -> None:
    """By `springlab results`, which leaves nothing behind."""
    before = sorted(read_only.rglob("*"))
    said = python("-c", NOBODY, "results", "--json", "--store", str(read_only / "store.sqlite"), folder=ROOT)
    assert (said.code, said.err) == (0, "")
    assert [row["number"] for row in json.loads(said.out)] == [1]
    assert sorted(read_only.rglob("*")) == before
