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
from typing import Any, NamedTuple, Protocol, TypeVar

from engines.process.isolation import MEMORY_LIMIT, TIME_LIMIT
from engines.process.supervisor import supervisor
from experiments.runs.store import Kept, Store
from experiments.runs.task import Job
from reference.outcome import Outcome

T = TypeVar("T")

#: Between one attempt to stop a crew and the next [s].
AGAIN = 0.1

#: A portion has so many jobs at most.
MOST = 1000


class Done(NamedTuple):
    """What a job answered, or the outcome that says why it did not; and how long it took [s]."""

    answer: Any
    seconds: float


class Crew(Protocol):
    """Those who do the jobs."""

    @property
    def size(self) -> int:
        """How many portions to give them at once."""

    @property
    def portion(self) -> float:
        """How long a portion of jobs should keep one of them busy [s], where handing it over takes time; else 0."""

    def do(self, jobs: Sequence[Job]) -> list[Done]:
        """Do a portion of jobs, one after another. Called from many threads."""

    def stop(self) -> None:
        """End all that is under way; those who wait get InterruptedError."""


class LocalCrew:
    """The cores of this machine.

    Args:
        size: how many jobs at once; left out, as many as there are cores.
    """

    portion = 0.0

    def __init__(self, size: int | None = None) -> None:
        self.size = size or os.cpu_count() or 1

    def do(self, jobs: Sequence[Job]) -> list[Done]:
        """See Crew."""
        return [do_here(job) for job in jobs]

    def stop(self) -> None:
        """See Crew."""
        supervisor().stop()


def do_here(job: Job) -> Done:
    """Do a job in a process of this machine."""
    begin = perf_counter()
    answer = supervisor().run(job.task, job.arguments, job.time_limit, job.memory_limit)
    return Done(answer, perf_counter() - begin)


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
        self._seconds = 0.0  # that these took
        self._fresh = fresh
        self._begun: set[str] = set()
        self._lock = threading.Lock()

    def answer(self, job: Job) -> Any:
        """What a job answers: from the store, or else by the crew, and then it is kept. For any thread to call."""
        return self._answers([job])[0]

    def _answers(self, jobs: Sequence[Job]) -> list[Any]:
        """The same of a portion of jobs."""
        kept = [self._kept(job) for job in jobs]
        missing = [job for job, found in zip(jobs, kept, strict=True) if found is None]
        done = iter(self._done(missing) if missing else [])
        return [next(done).answer if found is None else found.answer for found in kept]

    def _kept(self, job: Job) -> Kept | None:
        if self.store is None:
            return None
        if self._fresh and job.key not in self._begun:
            self.start_over([job])
        return self.store.find(job)

    def _done(self, jobs: Sequence[Job]) -> list[Done]:
        """What the crew does, kept."""
        done = self.crew.do(jobs)
        for job, (answer, seconds) in zip(jobs, done, strict=True):
            if self.store is not None:
                self.store.keep(job, answer, seconds)
        with self._lock:
            self.done += len(done)
            self._seconds += sum(seconds for _, seconds in done)
        return done

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
            under_way: dict[Future[list[Any]], list[Job]] = {}
            while True:
                while len(under_way) < 2 * self.crew.size and (portion := list(islice(waiting, self._portion()))):
                    under_way[threads.submit(self._answers, portion)] = portion
                if not under_way:
                    return
                for future in wait(under_way, return_when=FIRST_COMPLETED).done:
                    yield from zip(under_way.pop(future), future.result(), strict=True)

    def _portion(self) -> int:
        """How many jobs are a portion for the crew, by how long they took so far."""
        if not self.crew.portion or not self.done:
            return 1
        return max(1, min(MOST, int(self.crew.portion * self.done / self._seconds)))

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
