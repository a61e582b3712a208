"""The known ways to break each engine, and what becomes of it. Needs NumPy only.

Each is a function that does to an engine what should not be done, in a process of its own, and says how it went if it
is still there to say so. Any file of an engine enters its own with `crash_case`.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from engines.engine import modules
from reference.outcome import Outcome
from reference.registry import Registry, summary_of

#: How long a case may take before it counts as hanging [s].
TIME_LIMIT = 5.0

#: What a case may answer.
FINE, NOT_FINITE, RESET = "fine", "goes on with what is not a number", "starts over silently"


@dataclass(frozen=True)
class CrashCase:
    """One way to break an engine.

    Attributes:
        package: the engine's.
        function: does it, and answers with one of the words above.
    """

    package: str
    function: Callable[[], str]

    @property
    def name(self) -> str:
        """The function's, in words."""
        return self.function.__name__.replace("_", " ")

    @property
    def summary(self) -> str:
        """The first line of the function's docstring."""
        return summary_of(self.function)


_CASES = Registry[CrashCase]("crash case", modules)


def crash_case(package: str) -> Callable[[Callable[[], str]], Callable[[], str]]:
    """Enter the decorated function among the crash cases of a package.

    Raises:
        InputError: where the package has one of that name.
    """

    def enter(function: Callable[[], str]) -> Callable[[], str]:
        case = CrashCase(package, function)
        _CASES.enter(f"{package}: {case.name}", case, function.__module__)
        return function

    return enter


def crash_cases(package: str) -> Mapping[str, CrashCase]:
    """By name, all known ways to break an engine; none for a package that nobody has broken."""
    return {case.name: case for case in _CASES.all().values() if case.package == package}


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
    """FINE, or NOT_FINITE where one of the values is not."""
    return FINE if np.isfinite(np.asarray(values, dtype=float)).all() else NOT_FINITE
