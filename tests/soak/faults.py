"""A sweep in which every fifth run ends badly, and what is due of each: known beforehand, by the run's number.

NumPy only: this is imported in every process that does a run.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NoReturn

import numpy as np

from reference.outcome import Outcome
from reference.state import Trajectory
from tests.engines.process import misbehaving

#: How many runs end badly.
SHARE = 0.2

#: A run that hangs is given up after so long [s].
PATIENCE = 0.5

#: A process may hold so much memory [bytes], 300 MiB or a little more.
MEMORY = 0.3 * 2**30

SEED = 2026


@dataclass(frozen=True)
class Fault:
    """A way to end badly.

    Attributes:
        commit: what does it, given a small number.
        reason: what is to be said of it; it may have that number in it.
        ending: one of the words of an outcome.
    """

    commit: Callable[[int], object]
    reason: str
    ending: str = "crashed"


def eat(_: int) -> NoReturn:
    """Take twice the memory there is, page by page, and hold it."""
    taken = [np.ones(2**20) for _ in range(int(2 * MEMORY / 2**23))]
    time.sleep(60)
    raise AssertionError(f"{len(taken)} blocks were too few")


FAULTS = (
    Fault(lambda _: misbehaving.segfault(), "killed by SIGSEGV"),
    Fault(lambda _: misbehaving.abort(), "killed by SIGABRT; it said: no iterations: cannot go on"),
    Fault(lambda _: misbehaving.hang(), f"no answer within {PATIENCE:g} s", "timed out"),
    Fault(lambda _: misbehaving.sleep(), f"no answer within {PATIENCE:g} s", "timed out"),
    Fault(eat, "took more than 0.3 GiB of memory"),
    Fault(misbehaving.leave, "ended with exit code {} and no answer"),
    Fault(lambda n: sys.exit(n), "ended with exit code {} and no answer"),
    Fault(lambda n: sys.exit(f"run {n} is fed up"), "ended with exit code 1 and no answer; it said: run {} is fed up"),
    Fault(lambda _: misbehaving.divide(), "ZeroDivisionError: mass 3 is zero and cannot be divided by"),
)


def fault(number: int) -> Fault | None:
    """How a run ends badly; None if it does not."""
    generator = np.random.default_rng([SEED, number])
    return FAULTS[generator.integers(len(FAULTS))] if generator.random() < SHARE else None


def run(number: int) -> Any:
    """Do a run: 1 to 30 ms of it, an answer with an array, for some an outcome of their own; or end badly."""
    wrong = fault(number)
    if wrong is not None:
        wrong.commit(small(number))
    time.sleep(1e-3 * (1 + number % 30))
    return good_answer(number)


def good_answer(number: int) -> Any:
    """What a run answers that does not end badly: the same wherever it is asked."""
    points = np.random.default_rng(number).random((4, 2))
    if number % 11 == 0:
        trajectory = Trajectory(np.arange(2.0), points[:2, None], points[2:, None])
        return Outcome("diverged", f"run {number} is torn", trajectory)
    answer = {"number": number, "points": points, "mean": float(points.mean()), "nothing": None, "top": float("inf")}
    if number % 7 == 0:
        answer["outcome"] = Outcome("unsupported", f"run {number} has no engine")
    return answer


def due(number: int) -> tuple[str, str]:
    """A run's outcome and its reason."""
    wrong = fault(number)
    if wrong is not None:
        return wrong.ending, wrong.reason.format(small(number))
    if number % 11 == 0:
        return "diverged", f"run {number} is torn"
    if number % 7 == 0:
        return "unsupported", f"run {number} has no engine"
    return "done", ""


def small(number: int) -> int:
    """An exit code of the run's own, but not 255: so ends a process whose end nobody saw."""
    return number % 200


def end_oneself() -> NoReturn:
    """Be killed by oneself, as the kernel does for want of memory."""
    os.kill(os.getpid(), 9)
    raise AssertionError
