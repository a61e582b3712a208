"""Lengths of many vectors and many springs at once, axis by axis: that is several times as quick. Needs NumPy only."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from reference.state import Array
from reference.system import BoolArray, IntArray

#: So many springs are looked at together: what is computed of many frames of them stays near to the processor.
BLOCK = 512


def lengths(vectors: Array) -> Array:
    """Of vectors (..., d), shape (...)."""
    return np.asarray(np.sqrt(np.einsum("...i,...i->...", vectors, vectors)))


def _axes(values: Array) -> Array:
    """Of values (..., n, d), shape (d, n, ...): the times of many frames side by side, so that a mass is a row."""
    return np.ascontiguousarray(values.T)


def _apart(axes: Array, springs: IntArray) -> list[Array]:
    """The second end's less the first end's of every spring: of (d, n, ...), each (s, ...)."""
    a, b = springs.T
    return [axis.take(b, 0) - axis.take(a, 0) for axis in axes]


def _length(apart: list[Array]) -> Array:
    """Of vectors, axis by axis."""
    first, *others = apart
    squares = first * first
    for along in others:
        squares += along * along
    return np.asarray(np.sqrt(squares))


def _blocks(count: int) -> Iterator[slice]:
    """So many springs, BLOCK at a time."""
    return (slice(begin, begin + BLOCK) for begin in range(0, count, BLOCK))


def spring_lengths(positions: Array, springs: IntArray) -> Array:
    """How long springs are [m], with masses at positions (..., n, d) [m]: shape (..., s)."""
    axes = _axes(positions)
    length = np.empty((len(springs), *axes.shape[2:]))
    for block in _blocks(len(springs)):
        length[block] = _length(_apart(axes, springs[block]))
    return length.T


def divisors(length: Array, rest_lengths: Array) -> Array:
    """What springs' separations are divided by for their directions [m]: their lengths, both of shape (..., s).

    A spring of rest length 0 and no length has no direction and no force: divided by 1 it is the vector zero.
    """
    return np.where((length == 0) & (rest_lengths == 0), 1.0, length)


def lengths_and_rates(positions: Array, velocities: Array, springs: IntArray, wanted: BoolArray) -> tuple[Array, Array]:
    """How long springs are [m], and how fast they get longer [m/s], with masses (..., n, d): both (..., s).

    Rates are zero of springs that are not wanted: an engine that tells no velocities has forces all the same where a
    spring is not damped.
    """
    if not wanted.any():
        return spring_lengths(positions, springs), np.zeros(len(springs))
    x, v = _axes(positions), _axes(velocities)
    length = np.empty((len(springs), *x.shape[2:]))
    rate = np.zeros_like(length)
    with np.errstate(invalid="ignore", divide="ignore"):
        for block in _blocks(len(springs)):
            apart, speeds = (_apart(axes, springs[block]) for axes in (x, v))
            length[block] = _length(apart)
            for along, speed in zip(apart, speeds, strict=True):
                rate[block] += along * speed
            rate[block] /= length[block]
            rate[block][~(length[block] > 0) | ~wanted[block].reshape(-1, *(1,) * (length.ndim - 1))] = 0.0
    return length.T, rate.T
