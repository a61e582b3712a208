"""Numbers as they come in: finite, of the right shape, in their range, and such that products are floats too."""

from __future__ import annotations

import reprlib
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from reference.errors import InputError
from reference.state import Array

#: In SI units nothing that is simulated is larger, nor is a mass or a length smaller: products of a few are floats.
LARGEST, SMALLEST = 1e50, 1e-50


def finite(name: str, value: npt.ArrayLike, unit: str) -> Array:
    """Finite numbers of at most LARGEST. Raises InputError naming the first that is not."""
    try:
        array = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        raise InputError(f"{name} = {reprlib.repr(value)}: expected numbers [{unit}]") from None
    if not (np.abs(array) <= LARGEST).all():  # systems are made by the thousand: one look at those that are well
        refuse(name, array, ~np.isfinite(array), f"a finite number [{unit}]")
        refuse(name, array, np.abs(array) > LARGEST, f"a number of at most {LARGEST:g} [{unit}]")
    return array


def in_range(name: str, value: npt.ArrayLike, shape: tuple[int, ...], unit: str, above_zero: bool = False) -> Array:
    """Numbers of a shape, none below zero, or where they are to be above it, below SMALLEST. Raises InputError."""
    array = shaped(name, finite(name, value, unit), shape)
    refuse_below(name, array, unit, above_zero)
    return array


def refuse_below(name: str, array: Array, unit: str, above_zero: bool) -> None:
    """Refuse what is below zero, or where it is to be above it, what is not, or too little. Raises InputError."""
    bad = array <= 0 if above_zero else array < 0
    refuse(name, array, bad, f"a number {'> 0' if above_zero else '>= 0'} [{unit}]")
    if above_zero:
        refuse(name, array, array < SMALLEST, f"a number of at least {SMALLEST:g} [{unit}]")


def truths(name: str, value: npt.ArrayLike, of_each: str) -> npt.NDArray[np.bool_]:
    """True or false for each of something. Raises InputError for anything else."""
    try:
        array = np.asarray(value)
    except ValueError:  # lists of unequal lengths
        array = np.zeros(1)
    if array.dtype != bool and array.size:
        raise InputError(f"{name} = {value!r}: expected true or false for each {of_each}")
    return array.astype(bool)


def check_sizes(name: str, value: npt.ArrayLike, divided_by: bool = False) -> None:
    """Refuse numbers above LARGEST, or where something is divided by them, below SMALLEST. Raises InputError."""
    array = np.asarray(value, dtype=np.float64)
    refuse(name, array, np.abs(array) > LARGEST, f"a number of at most {LARGEST:g}")
    if divided_by:
        refuse(name, array, np.abs(array) < SMALLEST, f"a number of at least {SMALLEST:g}")


def refuse(name: str, array: Array, bad: npt.NDArray[np.bool_], expected: str) -> None:
    """Refuse the first number that is bad, with its index unless all are the same. Raises InputError."""
    if not bad.any():
        return
    index = tuple(int(i) for i in np.argwhere(bad)[0])
    same_everywhere = array.ndim == 1 and len(set(array.tolist())) == 1
    place = "" if not index or same_everywhere else "[" + ", ".join(map(str, index)) + "]"
    raise InputError(f"{name}{place} = {array[index]:g}: expected {expected}")


def refuse_twice(name: str, numbers: Sequence[float]) -> None:
    """Refuse the first of the numbers of masses or springs that stands there already. Raises InputError."""
    seen: set[float] = set()
    for place, number in enumerate(numbers):
        if number in seen:
            raise InputError(f"{name}[{place}] = {number:g}: expected every number once")
        seen.add(number)


def shaped(name: str, array: npt.NDArray[Any], shape: tuple[int, ...]) -> npt.NDArray[Any]:
    """The array; one number stands for all. Raises InputError for another shape."""
    if array.shape in ((), (1,)):
        return np.broadcast_to(array.reshape(()), shape)
    if array.shape != shape:
        raise InputError(f"{name} has shape {array.shape}: expected {shape}")
    return array
