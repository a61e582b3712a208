"""The known ways to break each engine, and what becomes of it: the crash list. Needs NumPy only.

Each is a function that does to an engine what should not be done, in a process of its own, and says how it went if it
is still there to say so. Any file of an engine enters its own with `breaks`.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from engines.engine import registry
from reference.outcome import Outcome

#: What is not over after so long [s] hangs.
TIME_LIMIT = 5.0

#: What a function of the list may answer.
FINE, NO_NUMBER, RESET = "fine", "goes on with what is not a number", "starts over silently"

_LIST: dict[str, dict[str, Breach]] = {}


@dataclass(frozen=True)
class Breach:
    """One way to break an engine.

    Attributes:
        package: the engine's.
        task: does it, and answers with one of the words above.
    """

    package: str
    task: Callable[[], str]

    @property
    def name(self) -> str:
        """The function's, in words."""
        return self.task.__name__.replace("_", " ")

    @property
    def summary(self) -> str:
        """The first line of the function's docstring."""
        return (self.task.__doc__ or "").splitlines()[0]


def breaks(package: str) -> Callable[[Callable[[], str]], Callable[[], str]]:
    """Enter the decorated function into the crash list of a package."""

    def enter(task: Callable[[], str]) -> Callable[[], str]:
        breach = Breach(package, task)
        _LIST.setdefault(package, {})[breach.name] = breach
        return task

    return enter


def crash_list(package: str) -> Mapping[str, Breach]:
    """By name, all known ways to break an engine; none for a package nobody knows to break."""
    registry()  # imports all files of this folder
    return _LIST.get(package, {})


def ending(answer: str | Outcome) -> str:
    """What becomes of the engine, in a word or two: what the function answered, a signal's name, an exception."""
    if isinstance(answer, str):
        return answer
    if answer.ending == "timed out":
        return "hangs"
    signal = re.match(r"killed by (\w+)", answer.reason)
    exception = re.match(r"\w+: ", answer.reason)
    return signal[1] if signal else f"refused: {answer.reason}" if exception else answer.reason


def numbers(values: Any) -> str:
    """FINE, or NO_NUMBER where one of the values is none."""
    return FINE if np.isfinite(np.asarray(values, dtype=float)).all() else NO_NUMBER
