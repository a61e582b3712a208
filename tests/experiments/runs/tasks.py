"""Tasks at once done, and jobs of them, for tests of what does jobs and keeps answers."""

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
from experiments.runs.task import Job
from reference.changes import Change
from reference.outcome import Ending, Outcome
from reference.scenes import find
from reference.state import Trajectory
from reference.system import MassSpringSystem

STRING = find("string").system({"masses": 3})


def stepped(engine: Engine, system: MassSpringSystem, dt: float, steps: int, changes: tuple[Change, ...]) -> Outcome:
    """A task with all that labels are made of."""
    return ended("done")


def numbered(number: int) -> int:
    """A task whose jobs differ in one number."""
    return number


def job(number: int = 0, **limits: float) -> Job:
    """A job of `numbered`."""
    return replace(Job(numbered, (number,), {"number": number}), **limits)  # type: ignore[arg-type]


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
    """Number and outcome of every row of a store of `job`s, in order."""
    return sorted((row["number"], row["outcome"]) for row in rows(file, {}, retired))


def kept(store: Store, number: int) -> Any:
    """The answer that a store has of a `job`."""
    found = store.find(job(number))
    assert found is not None
    return found.answer


class FakeCrew:
    """Those who do jobs in this very process, and remember which; a task may be done otherwise."""

    def __init__(self, size: int = 1, answers: Mapping[int, Any] | None = None, portion: float = 0.0) -> None:
        self.size, self.portion, self.stopped = size, portion, False
        self.portions: list[int] = []
        self.asked: list[int] = []
        self._answers, self._lock = answers or {}, threading.Lock()

    def do(self, jobs: Sequence[Job]) -> list[Done]:
        """See Crew. Every job takes 1/64 s, as it says."""
        self.portions.append(len(jobs))
        return [Done(self.do_one(job), 1 / 64) for job in jobs]

    def do_one(self, job: Job) -> Any:
        """What a job answers."""
        (number,) = job.arguments
        with self._lock:
            self.asked.append(number)
        answer = self._answers.get(number, number)
        if isinstance(answer, BaseException):
            raise answer
        return answer

    def stop(self) -> None:
        """See Crew."""
        self.stopped = True
