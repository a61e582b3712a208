"""A Dask cluster as a crew: every job goes to some worker, and there through the supervisor, as it would here."""

from __future__ import annotations

import importlib
import logging
import multiprocessing
import re
from concurrent.futures import CancelledError
from typing import Any

from engines.isolation import isolated
from engines.supervisor import KILLS
from experiments.job import Job
from reference.errors import InputError
from reference.outcome import Outcome

#: How long [s] to wait for a scheduler, and for its first worker.
PATIENCE = 10.0


class DaskCrew:
    """The workers of a Dask scheduler.

    Args:
        address: the scheduler's, tcp://HOST:PORT.
        size: how many jobs to give them at once; left out, twice as many as they have threads, so that none waits.

    Raises:
        InputError: where Dask is not installed, the scheduler is not there, or has no workers, or they have other
            versions than we do.
    """

    def __init__(self, address: str, size: int | None = None) -> None:
        try:
            dask: Any = importlib.import_module("distributed")
        except ImportError:
            raise InputError("--cluster: Dask is not installed; expected the extra springlab[cluster]") from None
        if not re.fullmatch(r"(tcp|tls)://[^\s:/]+:\d+", address):
            raise InputError(f"--cluster {address!r}: expected tcp://HOST:PORT of a Dask scheduler")
        # Of a lost scheduler it would log a traceback; that it is lost is ours to say, below.
        logging.getLogger("distributed.client").setLevel(logging.CRITICAL)
        self._address, self._lost = address, (dask.KilledWorker,)
        try:
            self._client = dask.Client(address, timeout=PATIENCE, set_as_default=False)
            self._client.wait_for_workers(1, timeout=PATIENCE)
        except OSError:  # a time-out is one too
            raise InputError(f"--cluster {address}: found no scheduler with workers within {PATIENCE:g} s") from None
        threads = sum(worker["nthreads"] for worker in self._client.scheduler_info(n_workers=-1)["workers"].values())
        self.size = size or 2 * threads

    def do(self, job: Job) -> Any:
        """See Crew. A worker that is lost costs the job another try, somewhere else."""
        for _ in range(KILLS):
            try:
                return self._client.submit(do_there, job, job.key, job.labels["version"], pure=False).result()
            except self._lost:
                continue
            except (CancelledError, OSError) as error:
                raise InputError(f"--cluster {self._address}: lost the scheduler ({type(error).__name__})") from None
        return Outcome("crashed", f"lost the worker it ran on, {KILLS} times over")

    def stop(self) -> None:
        """See Crew."""
        self._client.close(timeout=PATIENCE)


def do_there(job: Job, key: str, version: str | None) -> Any:
    """A job on a worker's machine, through its supervisor.

    Args:
        key: the job's where it was asked for.
        version: its engine's there.

    Raises:
        InputError: where the job's key is another one there: what decides its result is not the same; or where the
            worker may not start processes.
    """
    if multiprocessing.current_process().daemon:
        raise InputError(
            "a worker of the cluster may not start processes; expected DASK_DISTRIBUTED__WORKER__DAEMON=False"
        )
    there = Job(job.task, job.arguments, job.parameters, job.time_limit, job.memory_limit)
    if there.key != key:
        name, found = there.labels["stepper"], there.labels["version"]
        if found != version:
            raise InputError(f"a worker of the cluster has {name} in version {found}: expected {version}, as here")
        raise InputError("a worker of the cluster has another springlab, NumPy, Numba, SciPy or processor than we have")
    return isolated(job.task, *job.arguments, time_limit=job.time_limit, memory_limit=job.memory_limit)
