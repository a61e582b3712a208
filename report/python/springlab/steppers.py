"""What a stepper means wherever one is asked for."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from reference.errors import InputError

if TYPE_CHECKING:
    from reference.stepper import Stepper

#: What is taken as a stepper: a name, as `schemes()` and `engines()` list them, or a file of one's own.
AnyStepper = str | Path


def stepper_of(given: Any, time_limit: float | None = None) -> Stepper:
    """The stepper that is meant. What an own file does that a step should not is warned of.

    Args:
        time_limit: how long an engine may take [s].

    Raises:
        InputError: for an unknown name, an engine that is not installed, or what is no name.
    """
    from dataclasses import replace
    from math import isfinite

    from engines.process.isolation import EngineStepper
    from experiments.runs.steppers import find_steppers
    from reference.cache import remarks

    if time_limit is not None and not (isfinite(time_limit) and time_limit > 0):
        raise InputError(f"time_limit = {time_limit:g}: expected a finite number > 0 [s]")
    if not isinstance(given, str | Path):
        shown = getattr(given, "__name__", repr(given))
        what = shown if len(shown) <= 60 else f"of type {type(given).__name__}"
        raise InputError(
            f"stepper {what}: expected a name of schemes() or engines(), or a file; "
            'a function of your own goes into a file, given as "my_step.py"'
        )
    known = set(remarks)
    (found,) = find_steppers([str(given)])
    for remark in [remark for remark in remarks if remark not in known]:
        del remarks[remark]  # it is told here, and not once more at the end
        warnings.warn(remark, stacklevel=4)
    if time_limit is not None and isinstance(found, EngineStepper):
        return replace(found, time_limit=time_limit)
    return found


def steppers_of(given: Sequence[Any], time_limit: float | None = None) -> list[Stepper]:
    """All of them, each once; lists among them are read, too. Raises InputError as `stepper_of` does."""
    flat = [each for item in given for each in (item if isinstance(item, list | tuple) else [item])]
    for each in flat:
        if not isinstance(each, str | Path):
            stepper_of(each)  # says what was expected
    return [stepper_of(each, time_limit) for each in dict.fromkeys(flat)]
