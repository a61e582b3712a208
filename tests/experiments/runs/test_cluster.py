"""How tasks go to a Dask cluster and come back: with a scheduler that is made up here. The real one: tests/soak."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import CancelledError
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest

from engines.process.supervisor import KILLS
from experiments.runs import cluster
from experiments.runs.cluster import PATIENCE, DaskExecutor, do_there
from experiments.runs.runner import Done
from experiments.runs.task import Task
from reference.errors import InputError
from reference.outcome import Outcome
from tests.conformance.doctored import Doctored
from tests.experiments.runs.tasks import STRING, ended, numbered, stepped, task

ADDRESS = "tcp://127.0.0.1:8786"


class LostWorkerError(Exception):
    """What Dask says of a worker that is lost."""


class Scheduler:
    """In place of Dask: workers that do tasks here, or fail as they are told to."""

    def __init__(self) -> None:
        self.fails: Callable[[list[Any]], Exception | None] = lambda _: None
        self.asked: list[int] = []
        self.workers: dict[str, Any] = {"a": {"nthreads": 3}, "b": {"nthreads": 4}}
        self.closed = False
        self.Client, self.KilledWorker = self, LostWorkerError

    def __call__(self, address: str, timeout: float, set_as_default: bool) -> Scheduler:
        """A client of it, which is not to be that of others."""
        assert (address, timeout, set_as_default) == (ADDRESS, PATIENCE, False)
        if not self.workers:
            raise TimeoutError
        return self

    def wait_for_workers(self, count: int, timeout: float) -> None:
        """One is enough."""
        assert (count, timeout) == (1, PATIENCE)

    def scheduler_info(self, n_workers: int) -> dict[str, Any]:
        """Of all of them."""
        assert n_workers == -1
        return {"workers": self.workers}

    def submit(self, function: Callable[..., Any], asked: list[Any], pure: bool) -> Any:
        """A task that fails may be given again: it is not the same."""
        assert not pure
        self.asked.append(len(asked))

        def result() -> Any:
            if error := self.fails(asked):
                raise error
            return function(asked)

        return SimpleNamespace(result=result)

    def close(self, timeout: float) -> None:
        """No more is asked of it."""
        self.closed = timeout == PATIENCE


@pytest.fixture
def dask(monkeypatch: pytest.MonkeyPatch) -> Scheduler:
    """A scheduler with seven threads on two workers, which do tasks in this process."""
    made = Scheduler()
    monkeypatch.setattr(cluster.importlib, "import_module", lambda _: made)
    monkeypatch.setattr(cluster, "do_here", lambda task: Done(task.function(*task.arguments), 0.5))
    return made


def test_tasks_go_as_a_batch_and_come_back_in_order(dask: Scheduler) -> None:
    """To twice as many batches as there are threads, or as many as are asked for; in the end it is let go."""
    executor = DaskExecutor(ADDRESS)
    assert (executor.size, DaskExecutor(ADDRESS, 5).size) == (14, 5)
    assert executor.do([task(3), task(1), task(2)]) == [Done(n, 0.5) for n in (3, 1, 2)]
    assert dask.asked == [3]
    executor.stop()
    assert dask.closed


@pytest.mark.parametrize(
    "address", ["127.0.0.1:8786", "http://127.0.0.1:8786", "tcp://:8786", "tcp://host", "tcp://h:x"]
)
def test_what_is_no_address_is_refused(address: str, dask: Scheduler) -> None:
    """With its form."""
    with pytest.raises(InputError, match="expected tcp://HOST:PORT of a Dask scheduler"):
        DaskExecutor(address)


def test_a_scheduler_without_workers_is_told(dask: Scheduler, monkeypatch: pytest.MonkeyPatch) -> None:
    """As is that there is no Dask."""
    dask.workers = {}
    with pytest.raises(InputError, match=r"found no scheduler with workers within 10 s"):
        DaskExecutor(ADDRESS)

    def missing(_: str) -> None:
        raise ImportError

    monkeypatch.setattr(cluster.importlib, "import_module", missing)
    with pytest.raises(InputError, match=r"expected the extra springlab\[cluster\]"):
        DaskExecutor(ADDRESS)


def test_tasks_of_a_lost_worker_are_done_one_by_one(dask: Scheduler) -> None:
    """The one that is the reason is lost KILLS times, and told; the others have their answers."""

    def fails(asked: list[Any]) -> Exception | None:
        return LostWorkerError() if any(one.arguments == (2,) for one, *_ in asked) else None

    dask.fails = fails
    first, lost, last = DaskExecutor(ADDRESS).do([task(1), task(2), task(3)])
    assert (first, last) == (Done(1, 0.5), Done(3, 0.5))
    assert lost == Done(Outcome("crashed", f"lost the worker it ran on, {KILLS} times over"), 0.0)
    assert dask.asked == [3, 1, *[1] * KILLS, 1]


@pytest.mark.parametrize("error", [CancelledError(), ConnectionResetError()])
def test_a_lost_scheduler_is_told(error: Exception, dask: Scheduler) -> None:
    """By its address, and how it was lost."""
    dask.fails = lambda _: error
    with pytest.raises(InputError, match=f"--cluster {ADDRESS}: lost the scheduler \\({type(error).__name__}\\)"):
        DaskExecutor(ADDRESS).do([task(1)])


@pytest.mark.usefixtures("dask")
def test_a_worker_that_is_another_springlab_does_nothing() -> None:
    """It says in which version it has the engine, or that something else differs; nor one that starts no processes."""
    asked = Task(stepped, (Doctored(), STRING, 1e-3, 3, ()), {"number": 1})
    version = asked.labels["version"]
    ((answer, _),) = do_there([(asked, asked.key, version)])
    assert answer.ending == ended("done").ending
    with pytest.raises(
        InputError, match=f"a worker of the cluster has {Doctored().name} in version {version}: expected 0.1"
    ):
        do_there([(asked, "another key", "0.1")])
    with pytest.raises(InputError, match="another springlab, NumPy, Numba, SciPy or processor than we have"):
        do_there([(asked, "another key", version)])
    limited = replace(asked, time_limit=3.0, memory_limit=4.0)
    checked = cluster._checked(limited, limited.key, version)
    assert (checked.time_limit, checked.memory_limit, checked.parameters) == (3.0, 4.0, {"number": 1})
    assert checked.arguments == limited.arguments
    assert numbered(3) == 3


def test_a_worker_must_be_able_to_start_processes(dask: Scheduler, monkeypatch: pytest.MonkeyPatch) -> None:
    """A daemon may not: what Dask's setting is called is told."""
    daemon = SimpleNamespace(current_process=lambda: SimpleNamespace(daemon=True))
    monkeypatch.setattr(cluster, "multiprocessing", daemon)
    with pytest.raises(InputError, match="expected DASK_DISTRIBUTED__WORKER__DAEMON=False"):
        do_there([(task(1), task(1).key, None)])
    assert not dask.asked
