"""Ctrl-C in the middle of a sweep: one line, at once, nobody left behind; the same command goes on."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from random import Random
from threading import Event

import pytest

from experiments.runs.runner import Done, Runner
from experiments.runs.task import Task
from tests.engines.process import misbehaving
from tests.soak.children import check_all_end, family, start
from tests.soak.conftest import Size
from tests.soak.stored import kept_in

# What takes long here is run every few days, and with --full.
pytestmark = pytest.mark.rotating(7, in_turn=True)

#: Runs of the sweep, one after the other: some seconds of them.
RUNS = 40

#: Ctrl-C comes at most this time [s] after a run is kept: at any moment of the next.
MOMENT = 0.05

#: After Ctrl-C the command has ended within this time [s], however busy the machine is: runs that hang take ten times
#: as long.
PATIENCE = 600.0

SWEEP = (
    *(sys.executable, "-m", "report.commands.main", "sweep", "string"),
    *("--stepper", "heun", "--over", f"stiffness=100:200:{RUNS}", "--duration", "0.4", "--jobs", "1", "--json"),
)


def sweep(store: Path) -> subprocess.Popen[str]:
    """`springlab sweep`, with some more runs done."""
    before = kept_in(store)
    child = start(*SWEEP, environment={"SPRINGLAB_STORE": str(store)})
    wait_until(child, lambda: kept_in(store) > before)
    return child


def wait_until(child: subprocess.Popen[str], seen: Callable[[], bool]) -> None:
    """Until something is so, while a program runs."""
    deadline = time.monotonic() + PATIENCE
    while not seen():
        assert child.poll() is None, child.communicate()
        assert time.monotonic() < deadline
        time.sleep(0.02)


def test_an_interrupted_sweep_says_how_to_go_on_and_goes_on(tmp_path: Path, size: Size) -> None:
    """Exit code 130 and one line; what was kept is not run again."""
    store, random = tmp_path / "store.sqlite", Random(7)
    before = 0
    for _ in range(size.kills // 3):
        child = sweep(store)
        time.sleep(random.uniform(0, MOMENT))
        others = family(child.pid)
        os.killpg(child.pid, signal.SIGINT)
        out, err = child.communicate(timeout=PATIENCE)
        assert child.returncode == 130, err
        assert out == ""
        assert err == f"springlab: interrupted; what is done is kept in {store}: the same command goes on\n"
        check_all_end(others)
        assert before <= kept_in(store) < RUNS
        before = kept_in(store)
    done = start(*SWEEP, environment={"SPRINGLAB_STORE": str(store)})
    out, err = done.communicate(timeout=PATIENCE)
    document = json.loads(out)
    assert document["runs"] == RUNS
    assert document["run_now"] == RUNS - before < RUNS
    assert kept_in(store) == RUNS


@pytest.mark.parametrize("options", [(), ("--busy",)], ids=["waiting", "at work on an answer"])
def test_interrupted_with_runs_that_hang_it_ends_at_once(tmp_path: Path, options: tuple[str, ...]) -> None:
    """Those under way are ended, and those that would come next are not begun behind its back."""
    store = tmp_path / "store.sqlite"
    child = start(sys.executable, "-m", "tests.soak.hanging", str(store), *options)
    # Two processes, and what forks them and cleans up after them.
    wait_until(child, lambda: kept_in(store) == 1 and len(family(child.pid)) >= 4)
    others = family(child.pid)
    os.killpg(child.pid, signal.SIGINT)
    _, err = child.communicate(timeout=PATIENCE)
    assert (child.returncode, len(err.splitlines())) == (130, 1), err
    check_all_end(others)


class SlowToBegin:
    """An executor that looks whether it has been stopped only after the first time that it is.

    Attributes:
        begun: set once it was given a task.
        ended: whether it was stopped while it was at work.
    """

    size, batch_seconds = 1, 0.0

    def __init__(self) -> None:
        self.begun, self._too_early, self._stopped = Event(), Event(), Event()
        self.ended = False

    def do(self, tasks: Sequence[Task]) -> list[Done]:
        """Begin late, and end when stopped after that."""
        self.begun.set()
        self._too_early.wait(PATIENCE)
        self._stopped.clear()
        self.ended = self._stopped.wait(PATIENCE)
        return [Done(None, 0.0) for _ in tasks]

    def stop(self) -> None:
        """Once more."""
        self._stopped.set()
        self._too_early.set()


def interrupted(executor: SlowToBegin) -> None:
    """Ctrl-C while a thread is about to begin a run."""
    runner = Runner(executor)
    with runner.threads() as pool:
        pool.submit(runner.answer, Task(misbehaving.hang, ()))
        assert executor.begun.wait(PATIENCE)
        raise KeyboardInterrupt


def test_a_run_that_a_thread_was_about_to_begin_is_ended_too() -> None:
    """A single stop would come too early for it."""
    executor = SlowToBegin()
    with pytest.raises(KeyboardInterrupt):
        interrupted(executor)
    assert executor.ended
