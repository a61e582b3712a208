"""Lengths of many vectors and many springs at once, axis by axis: that is several times as quick. Needs NumPy only."""

from __future__ import annotations

import numpy as np

from reference.state import Array
from reference.system import BoolArray, IntArray


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


def divisors(length: Array, rest_lengths: Array) -> Array:
    """What springs' separations are divided by for their directions [m]: their lengths, both of shape (..., s).

    A spring of rest length 0 and no length has no direction and no force: divided by 1 it is the vector zero.
    """
    return np.where((length == 0) & (rest_lengths == 0), 1.0, length)


def rates_of(positions: Array, velocities: Array, springs: IntArray, wanted: BoolArray) -> Array:
    """How fast springs get longer [m/s], with masses (..., n, d): shape (..., s); zero of those that are not wanted.

    An engine that tells no velocities has forces all the same where a spring is not damped.
    """
    if not wanted.any():
        return np.zeros(len(springs))
    along = zip(between(positions, springs), between(velocities, springs), strict=True)
    length = spring_lengths(positions, springs)
    with np.errstate(invalid="ignore", divide="ignore"):
        rate = np.where(length > 0, sum(x * v for x, v in along) / length, 0.0)
    return np.where(wanted, rate, 0.0)
