"""Springs as they come in: two different masses each, which are apart. Raises InputError for others."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from reference.errors import InputError
from reference.state import Array

IntArray = npt.NDArray[np.int64]
BoolArray = npt.NDArray[np.bool_]


def refuse_together(springs: IntArray, positions: Array, rest_lengths: Array) -> None:
    """Refuse a spring without direction: of a rest length, between masses that start in one place."""
    a, b = springs.T
    together = (positions[a] == positions[b]).all(axis=1) & (rest_lengths > 0)
    if together.any():
        at = positions[a[np.argmax(together)]].tolist()
        _refuse_spring(springs, together, f"expected a length > 0, both masses start at {at}")


def checked_springs(value: npt.ArrayLike, n: int) -> IntArray:
    """Two of n masses for each spring, shape (s, 2)."""
    try:
        springs = np.asarray(value)
    except ValueError:
        raise InputError(f"springs = {value!r}: expected two masses for each spring") from None
    if springs.size == 0:
        return np.zeros((0, 2), dtype=np.int64)
    if springs.ndim != 2 or springs.shape[1] != 2 or not np.issubdtype(springs.dtype, np.integer):
        raise InputError(f"springs has shape {springs.shape} of {springs.dtype}: expected (s, 2) whole numbers")
    outside = np.asarray(((springs < 0) | (springs >= n)).any(axis=1))
    _refuse_spring(springs, outside, f"expected masses from 0 to {n - 1}")
    a, b = springs.T
    _refuse_spring(springs, np.asarray(a == b), "expected two different masses")
    return springs.astype(np.int64)


def _refuse_spring(springs: npt.NDArray[Any], bad: BoolArray, expected: str) -> None:
    if bad.any():
        j = int(np.argmax(bad))
        raise InputError(f"springs[{j}] = {springs[j].tolist()}: {expected}")
