"""What a student's function returned, as arrays; and a coefficient of drag by which schemes are told apart.

Used in the process of a submission, which finds NumPy and nothing else of the project.
"""

from __future__ import annotations

from collections.abc import Iterable, KeysView, Mapping, Sequence, Set
from typing import Any

import numpy as np

#: Kinds of arrays that are handed over: booleans, integers, floating-point numbers, words. No objects.
KINDS = "biufU"


class OddAnswerError(Exception):
    """Something was returned that is not what was asked for; its words are a finding's name, and what it is."""

    def __init__(self, name: str, words: str) -> None:
        super().__init__(f"{name}: {words}")


def split(value: Any, parts: Sequence[str]) -> list[Any]:
    """What was returned, thing by thing."""
    if len(parts) == 1:
        return [value]
    if isinstance(value, Mapping):
        raise OddAnswerError("returns_a_dict", "it returns a dict, which has no order")
    if isinstance(value, Set) and not isinstance(value, KeysView):
        raise OddAnswerError("returns_a_set", "it returns a set, which has no order")
    return list(value) if isinstance(value, Iterable) and not isinstance(value, str | bytes) else [value]


def parts_of(value: Any, parts: Sequence[str]) -> list[Any]:
    """What was returned, as arrays of its own; OddAnswerError in plain words where it is something else."""
    if value is None:
        raise OddAnswerError("returns_nothing", "it returns nothing: a return is missing")
    values = split(value, parts)
    if len(values) != len(parts):
        count = f"{len(values)} thing{'s'[: len(values) != 1]}"
        raise OddAnswerError("wrong_count", f"it returns {count}: expected {', '.join(parts)}")
    return [array_of(part, name) for part, name in zip(values, parts, strict=True)]


def array_of(value: Any, name: str) -> Any:
    """One thing that was returned, as an array of its own, of real numbers or of words."""
    if value is None:
        raise OddAnswerError("returns_nothing", f"{name} is None: nothing was computed for it")
    if isinstance(value, Mapping):
        raise OddAnswerError("returns_a_dict", f"{name} is a dict, which has no order")
    if callable(value) and not hasattr(value, "__array__"):
        raise OddAnswerError("not_numbers", f"{name} is a function: it was not called")
    if isinstance(value, Iterable) and not isinstance(value, str | bytes | list | tuple | np.ndarray | np.generic):
        value = value if hasattr(value, "__array__") else list(value)
    try:
        array = np.asarray(value)
    except ValueError:
        if any(part is None for part in value):
            raise OddAnswerError(
                "returns_nothing", f"{name} has None in it: something there was not computed"
            ) from None
        raise OddAnswerError("ragged", f"{name} has rows of different lengths") from None
    if array.dtype.kind == "O":
        array = numbers_of(array, name)
    if array.dtype.kind == "c":
        if array.imag.any():
            raise OddAnswerError("not_numbers", f"{name} has complex numbers in it")
        array = array.real
    if array.dtype.kind not in KINDS:
        raise OddAnswerError("not_numbers", f"{name} is not made of real numbers, but of {array.dtype}")
    return array.copy()


def numbers_of(array: Any, name: str) -> Any:
    """Python's own numbers, Fraction and Decimal among them, as floating-point ones."""
    for part in array.flat:
        if part is None:
            raise OddAnswerError("returns_nothing", f"{name} has None in it: something there was not computed")
        if isinstance(part, list | tuple | np.ndarray):
            raise OddAnswerError("ragged", f"{name} has rows of different lengths")
        if isinstance(part, str | bytes) or not hasattr(part, "__float__"):
            raise OddAnswerError("not_numbers", f"{name} has something in it that is no number: {type(part).__name__}")
    return array.astype(float)


class Growing(float):
    """A coefficient of drag that grows with the square of the speed that it is multiplied by.

    A program that only multiplies by it computes a force that is not linear in the velocity, without knowing.
    """

    __array_ufunc__ = None  # so that NumPy leaves products to this class

    def __mul__(self, speed: Any) -> Any:
        """The drag at a speed [m/s], a number or an array."""
        return float(self) * speed * (1.0 + speed * speed)

    __rmul__ = __mul__

    def __neg__(self) -> Growing:
        return Growing(-float(self))

    def __truediv__(self, by: Any) -> Growing:
        return Growing(float(self) / by)
