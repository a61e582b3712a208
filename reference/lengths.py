"""Lengths of many vectors and many springs at once, axis by axis: that is several times as quick. Needs NumPy only."""

from __future__ import annotations

import numpy as np

from reference.state import Array
from reference.system import IntArray


def lengths(vectors: Array) -> Array:
    """Of vectors (..., d), shape (...)."""
    return np.asarray(np.sqrt(np.einsum("...i,...i->...", vectors, vectors)))


def between(values: Array, springs: IntArray) -> list[Array]:
    """The second end's less the first end's of every spring, axis by axis: of values (..., n, d), each (..., s).

    With the times of many frames side by side in memory, so that a spring's ends are rows, and not single numbers.
    """
    a, b = springs.T
    axes = np.ascontiguousarray(values.T)
    return [(axis[b] - axis[a]).T for axis in axes]


def spring_lengths(positions: Array, springs: IntArray) -> Array:
    """How long springs are [m], with masses at positions (..., n, d) [m]: shape (..., s)."""
    first, *others = between(positions, springs)
    squares = first * first
    for along in others:
        squares += along * along
    return np.asarray(np.sqrt(squares))
