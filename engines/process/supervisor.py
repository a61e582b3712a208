"""Processes kept for tasks, and who is to blame when a task does not answer.

Processes are used again, which saves starting an engine for every run. So a task that ends badly in a process that has
served others may not be to blame: it is tried again in a fresh one, and what happens there is its outcome. Nor is a
task to blame for a process that is killed from outside: it is tried again, though not for ever.
"""

from __future__ import annotations

import atexit
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

from engines.process.worker import NoAnswerError, Worker
from reference.outcome import Outcome

#: How often a task's processes may be killed from outside before it is given up.
KILLS = 10


class Supervisor:
    """Processes that run tasks: one for each thread that asks, kept between tasks.

    Args:
        python: the interpreter they are of; left out, this one.
    """

    def __init__(self, python: Path | None = None) -> None:
        self._python = python
        self._lock = threading.Lock()
        self._idle: list[Worker] = []
        self._busy: set[Worker] = set()
        self._stops = 0

    def run(
        self, function: Callable[..., Any], arguments: tuple[Any, ...], time_limit: float, memory_limit: float
    ) -> Any:
        """What a function returns, called in a process of its own, or the outcome that says why it did not.

        Raises:
            InterruptedError: if the supervisor was stopped meanwhile.
        """
        kills, fresh, stops = 0, False, self._stops
        while True:
            worker = self._take(fresh, stops)
            try:
                answer = worker.do(function, arguments, time_limit, memory_limit)
            except NoAnswerError as failure:
                was_fresh = worker.fresh
                self._end(worker)
                kills += failure.from_outside
                if kills == KILLS:
                    return Outcome("crashed", f"{failure.outcome.reason}, {KILLS} times over")
                if was_fresh and not failure.from_outside:
                    return failure.outcome
                fresh = True
            except BaseException:
                self._end(worker)
                raise
            else:
                self._give_back(worker, stops)
                return answer

    def stop(self) -> None:
        """End all processes, whatever they are at. Those who wait for an answer are interrupted."""
        with self._lock:
            self._stops += 1
            for worker in self._busy:
                worker.kill()
            while self._idle:
                self._idle.pop().end()

    def pids(self) -> list[int]:
        """The processes there are now."""
        with self._lock:
            return [worker.pid for worker in (*self._idle, *self._busy) if worker.pid is not None]

    def _take(self, fresh: bool, stops: int) -> Worker:
        """An idle worker, or a new one."""
        with self._lock:
            if self._stops != stops:
                raise InterruptedError("stopped")
            worker = self._idle.pop() if self._idle and not fresh else Worker(self._python)
            self._busy.add(worker)
            return worker

    def _give_back(self, worker: Worker, stops: int) -> None:
        with self._lock:
            self._busy.remove(worker)
            if self._stops == stops:
                self._idle.append(worker)
                return
        worker.end()

    def _end(self, worker: Worker) -> None:
        with self._lock:
            self._busy.discard(worker)
        worker.end()


_supervisors: dict[Path | None, Supervisor] = {}
_lock = threading.Lock()


def supervisor(python: Path | None = None) -> Supervisor:
    """The supervisor of this process's own, for an interpreter."""
    with _lock:
        if python not in _supervisors:
            _supervisors[python] = Supervisor(python)
        return _supervisors[python]


@atexit.register
def stop_supervisors() -> None:
    """End all processes that tasks were done in."""
    with _lock:
        while _supervisors:
            _supervisors.popitem()[1].stop()
