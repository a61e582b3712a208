"""A Dask cluster as an executor: every task goes to some worker, and there through the supervisor, as it would here."""

from __future__ import annotations

import importlib
import logging
import multiprocessing
import re
from collections.abc import Sequence
from concurrent.futures import CancelledError
from typing import Any

from engines.process.supervisor import KILLS
from experiments.runs.runner import Done, do_here
from experiments.runs.task import Task
from reference.errors import InputError
from reference.outcome import Outcome

#: How long [s] to wait for a scheduler, and for its first worker.
PATIENCE = 10.0

#: How much work a batch is for a worker [s]: much more than handing it over takes, and little to do again.
BATCH_SECONDS = 5.0


class DaskExecutor:
    """The workers of a Dask scheduler. It takes milliseconds to hand something to one of them: tasks go in batches.

    Args:
        address: the scheduler's, tcp://HOST:PORT.
        size: how many batches to give them at once; left out, twice as many as they have threads, so that none waits.

    Raises:
        InputError: where Dask is not installed, the scheduler is not there, or has no workers, or they have other
            versions than we do.
    """

    batch_seconds = BATCH_SECONDS

    def __init__(self, address: str, size: int | None = None) -> None:
        try:
            dask: Any = importlib.import_module("distributed")
        except ImportError:
            raise InputError("--cluster: Dask is not installed; expected the extra springlab[cluster]") from None
        if not re.fullmatch(r"(tcp|tls)://[^\s:/]+:\d+", address):
            raise InputError(f"--cluster {address!r}: expected tcp://HOST:PORT of a Dask scheduler")
        # Of a lost scheduler it would log lines and a traceback; that it is lost is ours to say, below.
        for name in ("distributed", "distributed.client"):
            logging.getLogger(name).setLevel(logging.CRITICAL)
        self._address, self._lost = address, (dask.KilledWorker,)
        try:
            self._client = dask.Client(address, timeout=PATIENCE, set_as_default=False)
            self._client.wait_for_workers(1, timeout=PATIENCE)
        except OSError:  # a time-out is one too
            raise InputError(f"--cluster {address}: found no scheduler with workers within {PATIENCE:g} s") from None
        threads = sum(worker["nthreads"] for worker in self._client.scheduler_info(n_workers=-1)["workers"].values())
        self.size = size or 2 * threads

    def do(self, tasks: Sequence[Task]) -> list[Done]:
        """See Executor. A worker that is lost costs its tasks another try, elsewhere, in the end each by itself."""
        asked = [(task, task.key, task.labels["version"]) for task in tasks]
        for _ in range(KILLS):
            try:
                return list(self._client.submit(do_there, asked, pure=False).result())
            except self._lost:
                if len(tasks) > 1:
                    return [self.do([task])[0] for task in tasks]
            except (CancelledError, OSError) as error:
                raise InputError(f"--cluster {self._address}: lost the scheduler ({type(error).__name__})") from None
        return [Done(Outcome("crashed", f"lost the worker it ran on, {KILLS} times over"), 0.0)]

    def stop(self) -> None:
        """See Executor."""
        self._client.close(timeout=PATIENCE)


def do_there(asked: Sequence[tuple[Task, str, str | None]]) -> list[Done]:
    """Tasks on a worker's machine, through its supervisor.

    Args:
        asked: tasks, their keys where they were asked for, and their engines' versions there.

    Raises:
        InputError: where a task's key is another one there: what decides its result is not the same; or where the
            worker may not start processes.
    """
    if multiprocessing.current_process().daemon:
        raise InputError(
            "a worker of the cluster may not start processes; expected DASK_DISTRIBUTED__WORKER__DAEMON=False"
        )
    return [do_here(_checked(task, key, version)) for task, key, version in asked]


def _checked(task: Task, key: str, version: str | None) -> Task:
    """The task; what it is keyed by is looked up anew on this machine."""
    there = Task(task.function, task.arguments, task.parameters, task.time_limit, task.memory_limit)
    if there.key != key:
        name, found = there.labels["stepper"], there.labels["version"]
        if found != version:
            raise InputError(f"a worker of the cluster has {name} in version {found}: expected {version}, as here")
        raise InputError("a worker of the cluster has another springlab, NumPy, Numba, SciPy or processor than we have")
    return there
