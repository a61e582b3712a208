"""The program that runs a sweep is killed at random moments and started again: its store is as if it never had been."""

from __future__ import annotations

import shutil
import signal
import subprocess
import time
from pathlib import Path
from random import Random

import pytest

from tests.soak.children import check_all_end, family, run_sweep, start_sweep
from tests.soak.conftest import Size
from tests.soak.stored import (
    Row,
    arrays,
    check_accounted_for,
    check_same,
    check_same_files,
    check_same_rows,
    kept_in,
    rows,
)

# What takes long here is run every few days, and with --full.
pytestmark = pytest.mark.rotating(7, in_turn=True)

#: A kill comes at most so long [s] after the run it waits for: at any moment of the next.
MOMENT = 0.05

#: And at most so long [s] after the program has begun, where starting over is what is to be hit.
BLINK = 0.3


def kill(child: subprocess.Popen[str]) -> None:
    """Kill the program, and nobody else: what it has started must end by itself."""
    others = family(child.pid)
    assert others or child.poll() is None
    child.kill()
    child.communicate()
    assert child.returncode == -signal.SIGKILL, "it had ended before: more runs are needed"
    check_all_end(others)


def test_a_program_killed_again_and_again_goes_on_to_the_same_store(
    tmp_path: Path, size: Size, undisturbed: Path
) -> None:
    """Equal row for row and file for file, but for times; what was done before a kill is not done again."""
    store, random, begin = tmp_path / "store.sqlite", Random(5), time.perf_counter()
    before = 0
    for _ in range(size.kills):
        kill_under_way(store, size, random)
        kept = len(rows(store))
        assert kept >= before
        before = kept
    assert run_sweep(store, size.runs) == size.runs - before
    check_same(store, undisturbed)
    check_accounted_for(store, range(size.runs))
    seconds = time.perf_counter() - begin
    print(f"\n{size.kills} kills of the program, {before} of {size.runs} runs before the last, {seconds:.1f} s")


def test_starting_over_is_done_wholly_or_not_at_all(tmp_path: Path, size: Size, undisturbed: Path) -> None:
    """Killed in the middle of it, nothing has happened: the store is what it was, and there is nothing to do."""
    store = copy(undisturbed, tmp_path)
    child = start_sweep(store, size.runs, "--die-starting-over")
    child.communicate()
    assert child.returncode == -signal.SIGKILL
    check_same(store, undisturbed)
    assert run_sweep(store, size.runs) == 0


def test_a_program_killed_after_starting_over_goes_on(tmp_path: Path, size: Size, undisturbed: Path) -> None:
    """Old rows and arrays stay, all of them retired or none; in the end each has one current row, with what was."""
    store, random, old = copy(undisturbed, tmp_path), Random(6), arrays(undisturbed)
    while retired(store) == {0}:
        child = start_sweep(store, size.runs, "--fresh")
        time.sleep(random.uniform(0, BLINK))
        kill(child)
    assert retired(store) == {1}, "some rows were started over, and others not"
    for _ in range(size.kills):
        kill_under_way(store, size, random)
    run_sweep(store, size.runs)
    found = rows(store)
    assert [{**row, "retired": 0} for row in found if row["generation"] == 0] == rows(undisturbed)
    check_same_files({name: content for name, content in arrays(store).items() if name in old}, old)
    current = [row for row in found if not row["retired"]]
    check_same_rows(map(without_generation, current), map(without_generation, rows(undisturbed)))
    check_accounted_for(store, range(size.runs))
    assert len(found) == 2 * size.runs


def retired(store: Path) -> set[int]:
    """Whether rows of the first generation count as not yet run."""
    return {row["retired"] for row in rows(store) if row["generation"] == 0}


def kill_under_way(store: Path, size: Size, random: Random) -> None:
    """Kill the program at a random moment after a random number of runs: all kills are spread over the sweep."""
    goal = kept_in(store) + random.randrange(size.runs // (size.kills + 1))
    child = start_sweep(store, size.runs)
    while kept_in(store) < goal:
        assert child.poll() is None, child.communicate()
        time.sleep(0.01)
    time.sleep(random.uniform(0, MOMENT))
    kill(child)


def copy(store: Path, folder: Path) -> Path:
    """A store with its arrays, copied."""
    shutil.copytree(store.parent, folder / "copy")
    return folder / "copy" / store.name


def without_generation(row: Row) -> Row:
    """A row of whatever generation as if it were the first."""
    again = row["arrays"] and row["arrays"].replace(f"-{row['generation']}.", "-0.")
    return {**row, "generation": 0, "arrays": again}
