"""What a stepper means wherever one is asked for."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from reference.errors import InputError

if TYPE_CHECKING:
    from reference.stepper import Stepper

#: What is taken as a stepper: a name, as `schemes()` and `engines()` list them.
AnyStepper = str


def stepper_of(given: Any, time_limit: float | None = None) -> Stepper:
    """The stepper that is meant. An own file, or a function, would come in here.

    Args:
        time_limit: how long an engine may take [s].

    Raises:
        InputError: for an unknown name, an engine that is not installed, or what is no name.
    """
    from dataclasses import replace
    from math import isfinite

    from engines.process.isolation import EngineStepper
    from experiments.runs.steppers import find_steppers

    if time_limit is not None and not (isfinite(time_limit) and time_limit > 0):
        raise InputError(f"time_limit = {time_limit:g}: expected a finite number > 0 [s]")
    if not isinstance(given, str):
        raise InputError(f"stepper {given!r}: expected a name of schemes() or engines()")
    (found,) = find_steppers([given])
    if time_limit is not None and isinstance(found, EngineStepper):
        return replace(found, time_limit=time_limit)
    return found


def steppers_of(given: Sequence[Any], time_limit: float | None = None) -> list[Stepper]:
    """All of them, each once; lists among them are read, too. Raises InputError as `stepper_of` does."""
    flat = [each for item in given for each in (item if isinstance(item, list | tuple) else [item])]
    return [stepper_of(each, time_limit) for each in dict.fromkeys(flat)]
