"""The sweep with faults as a program of its own: `python -m tests.soak.sweep STORE COUNT`, to be killed at any moment.

It says "begun" when it has opened its store, and at its end how many runs it did.
"""

from __future__ import annotations

import argparse
import os
import signal
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

from experiments.runs.cluster import DaskExecutor
from experiments.runs.runner import LocalExecutor, Runner
from experiments.runs.store import Store
from experiments.runs.task import Task
from tests.soak import faults


def sweep_of(count: int) -> Iterator[Task]:
    """The tasks of the sweep, in order."""
    return map(task_of, range(count))


def task_of(number: int) -> Task:
    """One of them. Only a run that is to hang is given little time: a busy machine must not be taken for a hang."""
    wrong = faults.fault(number)
    hangs = wrong is not None and wrong.ending == "timed out"
    patience = faults.PATIENCE if hangs else 600.0
    return Task(faults.run, (number,), {"number": number}, time_limit=patience, memory_limit=faults.MEMORY)


def main() -> None:
    """Do the sweep."""
    parser = argparse.ArgumentParser()
    parser.add_argument("store", type=Path)
    parser.add_argument("count", type=int)
    parser.add_argument("--cluster", help="a Dask scheduler's address; left out, this machine's cores")
    parser.add_argument("--fresh", action="store_true", help="start over")
    parser.add_argument("--die-starting-over", action="store_true", help="be killed in the middle of that")
    wanted = parser.parse_args()
    store = Store(wanted.store)
    runner = Runner(LocalExecutor() if wanted.cluster is None else DaskExecutor(wanted.cluster), store)
    print("begun", flush=True)
    if wanted.die_starting_over:
        store.retire(deadly(wanted.count))
    if wanted.fresh:
        runner.start_over(sweep_of(wanted.count))
    with closing(runner.answers(sweep_of(wanted.count))) as answers:
        for _ in answers:
            pass
    print(f"done {runner.done}", flush=True)
    runner.executor.stop()


def deadly(count: int) -> Iterator[str]:
    """The tasks' keys, and death half-way."""
    for task in sweep_of(count // 2):
        yield task.key
    os.kill(os.getpid(), signal.SIGKILL)


if __name__ == "__main__":
    main()
