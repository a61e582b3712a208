"""A function called in another process, while this one is at something else."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TypeVar

from engines.process.isolation import isolated
from reference.outcome import Outcome

T = TypeVar("T")


def elsewhere(function: Callable[..., T], *arguments: object) -> T:
    """What a function returns, called in a process of its own, however long it takes.

    It is called here where no answer comes from there, so that what is wrong is told here.

    Args:
        function: of a module (it travels by name); its arguments travel as pickles. What it returns is no Outcome.
    """
    found = isolated(function, *arguments, time_limit=math.inf, memory_limit=math.inf)
    return function(*arguments) if isinstance(found, Outcome) else found
