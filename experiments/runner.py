"""Who does the jobs, and what is done with their answers: kept in a store, and not done again where one is kept.

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
from typing import Any, Protocol, TypeVar

from engines.isolation import MEMORY_LIMIT, TIME_LIMIT
from engines.supervisor import supervisor
from experiments.job import Job
from experiments.store import Store
from reference.outcome import Outcome

T = TypeVar("T")

#: Between one attempt to stop a crew and the next [s].
AGAIN = 0.1


class Crew(Protocol):
    """Those who do the jobs."""

    @property
    def size(self) -> int:
        """How many jobs to give them at once."""

    def do(self, job: Job) -> Any:
        """What the job answers, or the outcome that says why it does not. Called from many threads."""

    def stop(self) -> None:
        """End all that is under way; those who wait get InterruptedError."""


class LocalCrew:
    """The cores of this machine.

    Args:
        size: how many jobs at once; left out, as many as there are cores.
    """

    def __init__(self, size: int | None = None) -> None:
        self.size = size or os.cpu_count() or 1

    def do(self, job: Job) -> Any:
        """See Crew."""
        return supervisor().run(job.task, job.arguments, job.time_limit, job.memory_limit)

    def stop(self) -> None:
        """See Crew."""
        supervisor().stop()


class Runner:
    """A crew with a store.

    Args:
        fresh: whether to do again what is kept of earlier times.

    Attributes:
        done: how many jobs the crew has done.
    """

    def __init__(self, crew: Crew, store: Store | None = None, fresh: bool = False) -> None:
        self.crew, self.store = crew, store
        self.done = 0
        self._fresh = fresh
        self._begun: set[str] = set()
        self._lock = threading.Lock()

    def answer(self, job: Job) -> Any:
        """What a job answers: from the store, or else by the crew, and then it is kept. For any thread to call."""
        if self.store is None:
            return self.crew.do(job)
        if self._fresh and job.key not in self._begun:
            self.start_over([job])
        kept = self.store.find(job)
        if kept is not None:
            return kept.answer
        begin = perf_counter()
        answer = self.crew.do(job)
        self.store.keep(job, answer, perf_counter() - begin)
        with self._lock:
            self.done += 1
        return answer

    def start_over(self, jobs: Iterable[Job]) -> None:
        """Let jobs count as not yet done, all of them at once: should this be interrupted, it goes on from here."""
        if self.store is not None:
            keys = [job.key for job in jobs]
            self.store.retire(keys)
            self._begun.update(keys)

    def answers(self, jobs: Iterable[Job]) -> Generator[tuple[Job, Any], None, None]:
        """The answers of many jobs, as they come. Jobs are taken as they are needed: there may be millions."""
        waiting = iter(jobs)
        with self.threads() as threads:
            under_way: dict[Future[Any], Job] = {}
            while True:
                for job in islice(waiting, 2 * self.crew.size - len(under_way)):
                    under_way[threads.submit(self.answer, job)] = job
                if not under_way:
                    return
                for done in wait(under_way, return_when=FIRST_COMPLETED).done:
                    yield under_way.pop(done), done.result()

    @contextmanager
    def threads(self, count: int | None = None) -> Iterator[ThreadPoolExecutor]:
        """Threads to wait for the crew in. Where one is interrupted or fails, nothing goes on behind its back."""
        begun: list[threading.Thread] = []
        size = count or self.crew.size
        with ThreadPoolExecutor(size, initializer=lambda: begun.append(threading.current_thread())) as pool:
            try:
                yield pool
            except BaseException:
                pool.shutdown(wait=False, cancel_futures=True)
                self._stop(begun)
                raise

    def _stop(self, threads: Sequence[threading.Thread]) -> None:
        """End what is under way, also what a thread is just about to give to the crew."""
        self.crew.stop()
        while alive := [thread for thread in threads if thread.is_alive()]:
            alive[0].join(AGAIN)
            self.crew.stop()


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
    return _current[-1] if _current else Runner(LocalCrew())


def answer(
    task: Callable[..., T], *arguments: Any, time_limit: float = TIME_LIMIT, memory_limit: float = MEMORY_LIMIT
) -> T | Outcome:
    """What a task answers in a process of its own, somewhere, perhaps long ago; or why it does not."""
    found: T | Outcome = current().answer(Job(task, arguments, {}, time_limit, memory_limit))
    return found
