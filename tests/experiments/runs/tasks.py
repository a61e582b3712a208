"""Functions that return at once, and tasks of them, for tests of what does tasks and keeps answers."""

from __future__ import annotations

import threading
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from engines.engine import Engine
from experiments.runs.results import rows
from experiments.runs.runner import Done
from experiments.runs.store import Store
from experiments.runs.task import Task
from reference.changes import Change
from reference.outcome import Ending, Outcome
from reference.scenes import find
from reference.state import Trajectory
from reference.system import MassSpringSystem

STRING = find("string").system({"masses": 3})


def stepped(engine: Engine, system: MassSpringSystem, dt: float, steps: int, changes: tuple[Change, ...]) -> Outcome:
    """A function with all that labels are made of."""
    return ended("done")


def numbered(number: int) -> int:
    """A function whose tasks differ in one number."""
    return number


def task(number: int = 0, **limits: float) -> Task:
    """A task of `numbered`."""
    return replace(Task(numbered, (number,), {"number": number}), **limits)  # type: ignore[arg-type]


def ended(ending: Ending, reason: str = "", frames: int = 4) -> Outcome:
    """An outcome, with a trajectory where it has one: numbers with all their bits, and some that are none."""
    if ending not in ("done", "diverged"):
        return Outcome(ending, reason)
    x = np.random.default_rng(1).normal(size=(frames, 3, 2))
    v = np.full_like(x, np.nan)
    v[0] = np.inf, -0.0
    return Outcome(ending, reason, Trajectory(np.arange(frames) / 3, x, v))


def alike(one: Any, other: Any) -> bool:
    """Whether two answers are the same bit for bit; a list is as good as a tuple."""
    if isinstance(one, Outcome) and isinstance(other, Outcome):
        return (one.ending, one.reason) == (other.ending, other.reason) and alike(one.trajectory, other.trajectory)
    if isinstance(one, Trajectory) and isinstance(other, Trajectory):
        return all(alike(getattr(one, name), getattr(other, name)) for name in ("times", "positions", "velocities"))
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        return (one.dtype, one.shape, one.tobytes()) == (other.dtype, other.shape, other.tobytes())
    if isinstance(one, Mapping) and isinstance(other, Mapping):
        return [*one] == [*other] and all(alike(one[key], other[key]) for key in one)
    if isinstance(one, list | tuple) and isinstance(other, list | tuple):
        return len(one) == len(other) and all(map(alike, one, other))
    return type(one) is type(other) and repr(one) == repr(other)


def arrays_of(file: Path) -> list[Path]:
    """The files of arrays beside a store."""
    return sorted(path for path in (file.parent / "arrays").rglob("*") if path.is_file())


def endings(file: Path, retired: bool = False) -> list[tuple[int, str]]:
    """Number and outcome of every row of a store of `task`s, in order."""
    return sorted((row["number"], row["outcome"]) for row in rows(file, {}, retired))


def kept(store: Store, number: int) -> Any:
    """The answer that a store has of a `task`."""
    found = store.find(task(number))
    assert found is not None
    return found.answer


class FakeExecutor:
    """Those who do tasks in this very process, and remember which; an answer may be another than the function's."""

    def __init__(self, size: int = 1, answers: Mapping[int, Any] | None = None, batch_seconds: float = 0.0) -> None:
        self.size, self.batch_seconds, self.stopped = size, batch_seconds, False
        self.batches: list[int] = []
        self.asked: list[int] = []
        self._answers, self._lock = answers or {}, threading.Lock()

    def do(self, tasks: Sequence[Task]) -> list[Done]:
        """See Executor. Every task takes 1/64 s, as it says."""
        self.batches.append(len(tasks))
        return [Done(self.do_one(task), 1 / 64) for task in tasks]

    def do_one(self, task: Task) -> Any:
        """What a task answers."""
        (number,) = task.arguments
        with self._lock:
            self.asked.append(number)
        answer = self._answers.get(number, number)
        if isinstance(answer, BaseException):
            raise answer
        return answer

    def stop(self) -> None:
        """See Executor."""
        self.stopped = True
