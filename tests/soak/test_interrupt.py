"""Ctrl-C in the middle of a sweep: one line, at once, nobody left behind; the same command goes on."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from random import Random

import pytest

from experiments.runs.runner import Done, Runner
from experiments.runs.task import Task
from tests.engines.process import misbehaving
from tests.soak.children import check_all_end, family, start
from tests.soak.conftest import Size
from tests.soak.stored import kept_in

#: Runs of the sweep: some seconds of them.
RUNS = 60

#: After Ctrl-C the command has ended within [s]: on the busiest machine, and long before runs that hang are given up.
PATIENCE = 60.0

SWEEP = (
    *(sys.executable, "-m", "report.commands.main", "sweep", "string"),
    *("--stepper", "heun", "--over", f"stiffness=100:200:{RUNS}", "--duration", "0.2", "--json"),
)


def sweep(store: Path) -> subprocess.Popen[str]:
    """`springlab sweep`, with some more runs done."""
    before = kept_in(store)
    child = start(*SWEEP, environment={"SPRINGLAB_STORE": str(store)})
    deadline = time.monotonic() + 60
    while kept_in(store) == before:
        assert child.poll() is None, child.communicate()
        assert time.monotonic() < deadline
        time.sleep(0.05)
    return child


def test_an_interrupted_sweep_says_how_to_go_on_and_goes_on(tmp_path: Path, size: Size) -> None:
    """Exit code 130 and one line; what was kept is not run again."""
    store, random = tmp_path / "store.sqlite", Random(7)
    before = 0
    for _ in range(size.kills // 3):
        child = sweep(store)
        time.sleep(random.uniform(0, 0.2))
        others, begin = family(child.pid), time.monotonic()
        os.killpg(child.pid, signal.SIGINT)
        out, err = child.communicate(timeout=60)
        assert time.monotonic() - begin < PATIENCE
        assert child.returncode == 130, err
        assert out == ""
        assert err == f"springlab: interrupted; what is done is kept in {store}: the same command goes on\n"
        check_all_end(others)
        assert before <= kept_in(store) < RUNS
        before = kept_in(store)
    done = start(*SWEEP, environment={"SPRINGLAB_STORE": str(store)})
    out, err = done.communicate(timeout=120)
    document = json.loads(out)
    assert document["runs"] == RUNS
    assert document["run_now"] == RUNS - before < RUNS
    assert kept_in(store) == RUNS


@pytest.mark.parametrize("options", [(), ("--busy",)], ids=["waiting", "at work on an answer"])
def test_interrupted_with_runs_that_hang_it_ends_at_once(tmp_path: Path, options: tuple[str, ...]) -> None:
    """Those under way are ended, and those that would come next are not begun behind its back."""
    child = start(sys.executable, "-m", "tests.soak.hanging", str(tmp_path / "store.sqlite"), *options)
    assert child.stdout is not None
    assert child.stdout.readline() == "begun\n"
    time.sleep(1.5)
    others, begin = family(child.pid), time.monotonic()
    os.killpg(child.pid, signal.SIGINT)
    _, err = child.communicate(timeout=120)
    assert time.monotonic() - begin < PATIENCE
    assert (child.returncode, len(err.splitlines())) == (130, 1), err
    assert len(others) >= 4, "two processes, and what forks them and cleans up after them"
    check_all_end(others)


class SlowToBegin:
    """An executor that looks whether it has been stopped only a while after it was given a task."""

    size, batch_seconds = 1, 0.0

    def __init__(self) -> None:
        self.stops = 0

    def do(self, tasks: Sequence[Task]) -> list[Done]:
        """Begin late, and end when stopped after that."""
        time.sleep(0.3)
        stops, begin = self.stops, time.monotonic()
        while self.stops == stops and time.monotonic() - begin < 2 * PATIENCE:
            time.sleep(0.01)
        return [Done(None, 0.0) for _ in tasks]

    def stop(self) -> None:
        """Once more."""
        self.stops += 1


def interrupted(runner: Runner) -> None:
    """Ctrl-C while a thread is about to begin a run."""
    with runner.threads() as pool:
        pool.submit(runner.answer, Task(misbehaving.hang, ()))
        time.sleep(0.1)
        raise KeyboardInterrupt


def test_a_run_that_a_thread_was_about_to_begin_is_ended_too() -> None:
    """A single stop would come too early for it."""
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        interrupted(Runner(SlowToBegin()))
    assert time.monotonic() - begin < PATIENCE
