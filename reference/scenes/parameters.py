"""Parameters of scenes as they are given: words, numbers, one for all or one for each; text of any of these."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from reference.checked_numbers import refuse, refuse_below
from reference.errors import InputError
from reference.state import Array
from reference.system import check_parameter

#: One number for all, or one for each.
PerItem = float | Sequence[float]

#: More masses than that are a slip of the finger, and would fill the memory.
MOST_MASSES = 10_000_000


def counted(name: str, value: int, least: int = 1, most: int = MOST_MASSES) -> int:
    """The number, if it is in that range. Raises InputError."""
    if not least <= value <= most:
        raise InputError(f"{name} = {value:g}: expected a whole number from {least} to {most:,}")
    return value


def not_below_zero(**values: float) -> None:
    """Refuse a number below zero, by its name. Raises InputError."""
    for name, value in values.items():
        if not value >= 0:
            raise InputError(f"{name} = {value:g}: expected a number >= 0")


def each(name: str, value: PerItem, count: int) -> Array:
    """One number for each of `count` items, shape (count,). Raises InputError for another number of numbers."""
    values = np.asarray(value, dtype=np.float64)
    if values.ndim == 1 and len(values) != count:
        raise InputError(f"{name} has {len(values)} numbers: expected one, or one for each of {count}")
    return np.array(np.broadcast_to(values, (count,)))


def chosen(name: str, value: Any, words: tuple[str, ...]) -> str:
    """The value, if it is one of the words. Raises InputError."""
    if value not in words:
        raise InputError(f"{name} = {value!r}: expected one of {', '.join(words)}")
    return str(value)


def converted(name: str, value: Any, default: Any, several: bool) -> Any:
    """The value as the type its default has, or several: text from the command line, or numbers from a file.

    Raises:
        InputError: for what is no such number, or several where one was expected.
    """
    whole = isinstance(default, int)
    parts = value.split(",") if isinstance(value, str) else value if isinstance(value, list) else [value]
    try:
        if any(isinstance(part, bool | list | dict) for part in parts):
            raise ValueError
        numbers = [_whole(part) if whole else float(part) for part in parts]
    except (TypeError, ValueError, OverflowError):
        expected = "a whole number" if whole else "a number"
        raise InputError(f"{name} = {value!r}: expected {expected}") from None
    if name == "rest_length":  # a system's may be 0; but scenes are laid out by it
        works = "--change 0:rest_length=0 makes it 0 from the start, as does [[changes]] in a scene file"
        refuse(
            name,
            np.asarray(numbers),
            np.asarray(numbers) == 0,
            f"a number > 0 [m], as scenes are laid out by it; {works}",
        )
        refuse_below(name, np.asarray(numbers, dtype=np.float64), "m", above_zero=True)
    for number in numbers:
        check_parameter(name, number)
    if len(numbers) == 1 and not isinstance(value, list):
        return numbers[0]
    if not several:
        raise InputError(f"{name} = {value!r}: expected one number")
    return numbers


def _whole(part: Any) -> int:
    if float(part) != int(float(part)):
        raise ValueError
    return int(float(part))
