"""What a stepper means wherever one is asked for."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from reference.errors import InputError

if TYPE_CHECKING:
    from engines.own.stepper import OwnStepper
    from reference.stepper import Stepper

#: What is taken as a stepper: a name, as `schemes()` and `engines()` list them, a file of one's own, or a function in
#: one of the forms of such a file.
AnyStepper: TypeAlias = str | Path | Callable[..., Any]


def stepper_of(given: Any, time_limit: float | None = None, taken: Iterable[str] = ()) -> Stepper:
    """The stepper that is meant. What an own file or function does that a step should not is warned of.

    Args:
        time_limit: how long an engine may take [s].
        taken: names of others beside it: a function has another one.

    Raises:
        InputError: for an unknown name, an engine that is not installed, a function whose parameters are of no form, or
            what is none of these.
    """
    from dataclasses import replace
    from math import isfinite

    from engines.process.isolation import EngineStepper

    if time_limit is not None and not (isfinite(time_limit) and time_limit > 0):
        raise InputError(f"time_limit = {time_limit:g}: expected a finite number > 0 [s]")
    if not isinstance(given, str | Path) and callable(given):
        own = _of_function(given, taken)
        if time_limit is not None:
            _warn(f"time_limit: {own.name} is a function, and runs in this process without one")
        return own
    if not isinstance(given, str | Path):
        shown = repr(given)
        what = shown if len(shown) <= 60 else f"of type {type(given).__name__}"
        raise InputError(
            f"stepper {what}: expected a name of schemes() or engines(), a file, or a function of your own"
        )
    found = _named(str(given))
    if time_limit is not None and isinstance(found, EngineStepper):
        return replace(found, time_limit=time_limit)
    return found


def steppers_of(given: Sequence[Any], time_limit: float | None = None) -> list[Stepper]:
    """All of them, each once; lists among them are read, too. Raises InputError as `stepper_of` does."""
    found: list[Stepper] = []
    seen: list[Any] = []
    for item in given:
        for each in item if isinstance(item, list | tuple) else [item]:
            if not any(each is other or (isinstance(each, str | Path) and each == other) for other in seen):
                seen.append(each)
                found.append(stepper_of(each, time_limit, [stepper.name for stepper in found]))
    return found


def all_of(steppers: Sequence[Any], by_keyword: Any) -> tuple[Any, ...]:
    """Those given by position, then those given by keyword: one, several, or none, as ()."""
    return (*steppers, by_keyword) if by_keyword != () else tuple(steppers)


def _named(name: str) -> Stepper:
    from experiments.runs.steppers import find_steppers
    from reference.cache import remarks

    known = set(remarks)
    (found,) = find_steppers([name])
    for remark in [remark for remark in remarks if remark not in known]:
        del remarks[remark]  # it is told here, and not once more at the end
        _warn(remark)
    return found


def _of_function(function: Callable[..., Any], taken: Iterable[str]) -> OwnStepper:
    """Its stepper, by its own name: where a scheme or another stepper has that, with a word or a number behind it."""
    from itertools import chain, count

    from engines.engine import registry
    from engines.own import stepper as own
    from reference.printable import printable
    from report.derived import in_catalogue

    found = own.stepper_of(function)
    name, others = printable(found.name), set(taken)
    if in_catalogue(name) or name in registry():
        name = f"{name} (function)"
    name = next(n for n in chain([name], (f"{name} ({i})" for i in count(2))) if n not in others)
    found = own.stepper_of(function, name)
    for remark in found.remarks():
        _warn(remark)
    return found


def _warn(text: str) -> None:
    """Warn, at the line that called the lab."""
    frame, level = sys._getframe(), 1
    while frame.f_back is not None and Path(frame.f_code.co_filename).parent == Path(__file__).parent:
        frame, level = frame.f_back, level + 1
    warnings.warn(text, stacklevel=level)
