"""Who does the tasks, and what becomes of their answers: kept in a store, and not asked for again where one is kept.

Experiments ask `answer` for what an engine is to do in a process of its own, and need not know more. Which runner is at
work is chosen by the command that runs them: on this machine's cores or on a cluster, with a store or without.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Generator, Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from contextlib import contextmanager
from itertools import islice
from time import perf_counter
from typing import Any, NamedTuple, Protocol, TypeVar

from engines.process.isolation import MEMORY_LIMIT, TIME_LIMIT, isolated
from engines.process.supervisor import stop_supervisors
from experiments.runs.store import Store, Stored
from experiments.runs.task import Task
from reference.outcome import Outcome

T = TypeVar("T")

#: Between one attempt to stop an executor and the next [s].
AGAIN = 0.1

#: The most tasks of a batch.
LARGEST_BATCH = 1000


class Done(NamedTuple):
    """What a task answered, or the outcome that says why it did not; and how long it took [s]."""

    answer: Any
    seconds: float


class Executor(Protocol):
    """Those who do the tasks."""

    @property
    def size(self) -> int:
        """How many batches to give them at once."""

    @property
    def batch_seconds(self) -> float:
        """How long a batch of tasks should keep one of them busy [s], where handing it over takes time; else 0."""

    def do(self, tasks: Sequence[Task]) -> list[Done]:
        """Do a batch of tasks, one after another. Called from many threads."""

    def stop(self) -> None:
        """End all that is under way; those who wait get InterruptedError."""


class LocalExecutor:
    """The cores of this machine.

    Args:
        size: how many tasks at once; left out, as many as there are cores.
    """

    batch_seconds = 0.0

    def __init__(self, size: int | None = None) -> None:
        self.size = size or os.cpu_count() or 1

    def do(self, tasks: Sequence[Task]) -> list[Done]:
        """See Executor."""
        return [do_here(task) for task in tasks]

    def stop(self) -> None:
        """See Executor."""
        stop_supervisors()


def do_here(task: Task) -> Done:
    """Do a task in a process of this machine, by the Python of the engine among its arguments."""
    begin = perf_counter()
    answer = isolated(task.function, *task.arguments, time_limit=task.time_limit, memory_limit=task.memory_limit)
    return Done(answer, perf_counter() - begin)


class Runner:
    """An executor with a store.

    Args:
        fresh: whether to do again what is kept of earlier times.

    Attributes:
        done: how many tasks the executor has done.
    """

    def __init__(self, executor: Executor, store: Store | None = None, fresh: bool = False) -> None:
        self.executor, self.store = executor, store
        self.done = 0
        self._seconds = 0.0  # that these took
        self._fresh = fresh
        self._begun: set[str] = set()
        self._lock = threading.Lock()

    def answer(self, task: Task) -> Any:
        """What a task answers: from the store, or else by the executor, and then it is kept. For any thread to call."""
        return self._answers([task])[0]

    def _answers(self, tasks: Sequence[Task]) -> list[Any]:
        """The same of a batch of tasks."""
        stored = [self._stored(task) for task in tasks]
        missing = [task for task, found in zip(tasks, stored, strict=True) if found is None]
        done = iter(self._done(missing) if missing else [])
        return [next(done).answer if found is None else found.answer for found in stored]

    def _stored(self, task: Task) -> Stored | None:
        if self.store is None:
            return None
        if self._fresh and task.key not in self._begun:
            self.start_over([task])
        return self.store.find(task)

    def _done(self, tasks: Sequence[Task]) -> list[Done]:
        """What the executor does, kept."""
        done = self.executor.do(tasks)
        for task, (answer, seconds) in zip(tasks, done, strict=True):
            if self.store is not None:
                self.store.keep(task, answer, seconds)
        with self._lock:
            self.done += len(done)
            self._seconds += sum(seconds for _, seconds in done)
        return done

    def start_over(self, tasks: Iterable[Task]) -> None:
        """Let tasks count as not yet done, all of them at once: should this be interrupted, it goes on from here."""
        if self.store is not None:
            keys = [task.key for task in tasks]
            self.store.retire(keys)
            self._begun.update(keys)

    def answers(self, tasks: Iterable[Task]) -> Generator[tuple[Task, Any], None, None]:
        """The answers of many tasks, as they come. Tasks are taken as they are needed: there may be millions."""
        waiting = iter(tasks)
        with self.threads() as threads:
            under_way: dict[Future[list[Any]], list[Task]] = {}
            while True:
                while len(under_way) < 2 * self.executor.size and (batch := list(islice(waiting, self._batch_size()))):
                    under_way[threads.submit(self._answers, batch)] = batch
                if not under_way:
                    return
                for future in wait(under_way, return_when=FIRST_COMPLETED).done:
                    yield from zip(under_way.pop(future), future.result(), strict=True)

    def _batch_size(self) -> int:
        """How many tasks are a batch for the executor, by how long they took so far."""
        if not self.executor.batch_seconds or not self.done:
            return 1
        return max(1, min(LARGEST_BATCH, int(self.executor.batch_seconds * self.done / self._seconds)))

    @contextmanager
    def threads(self, count: int | None = None) -> Iterator[ThreadPoolExecutor]:
        """Threads to wait for the executor in. Where one is interrupted or fails, nothing goes on behind its back."""
        begun: list[threading.Thread] = []
        size = count or self.executor.size
        with ThreadPoolExecutor(size, initializer=lambda: begun.append(threading.current_thread())) as pool:
            try:
                yield pool
            except BaseException:
                pool.shutdown(wait=False, cancel_futures=True)
                self._stop(begun)
                raise

    def _stop(self, threads: Sequence[threading.Thread]) -> None:
        """End what is under way, also what a thread is just about to give to the executor."""
        self.executor.stop()
        while alive := [thread for thread in threads if thread.is_alive()]:
            alive[0].join(AGAIN)
            self.executor.stop()


_current: list[Runner] = []


@contextmanager
def using(runner: Runner) -> Iterator[None]:
    """Let a runner do what is asked for meanwhile."""
    _current.append(runner)
    try:
        yield
    finally:
        _current.pop()


def current() -> Runner:
    """The runner at work; where none was chosen, this machine's cores without a store."""
    return _current[-1] if _current else Runner(LocalExecutor())


def answer(
    function: Callable[..., T], *arguments: Any, time_limit: float = TIME_LIMIT, memory_limit: float = MEMORY_LIMIT
) -> T | Outcome:
    """What a function answers in a process of its own, somewhere, perhaps long ago; or why it does not."""
    found: T | Outcome = current().answer(Task(function, arguments, {}, time_limit, memory_limit))
    return found
