"""Vectors as one entry per axis: what is written so works on numbers, on arrays of them and on symbols (`tracing`)."""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce
from operator import add, mul
from typing import Any

import numpy as np

from reference.errors import InputError
from reference.state import Array

#: One entry per axis: each a number, an array of them, or a symbol.
Axes = Sequence[Any]


def dot(one: Axes, other: Axes) -> Any:
    """The product of two vectors, summed in the order of the axes."""
    return reduce(add, map(mul, one, other))


def less(one: Axes, other: Axes) -> Axes:
    """The first vector less the second."""
    return [a - b for a, b in zip(one, other, strict=True)]


def direction(away: Axes, otherwise: Axes) -> tuple[Any, Axes]:
    """The length of a vector, and its direction; of no length, `otherwise`."""
    length = np.sqrt(dot(away, away))
    some = length > 0
    divisor = np.where(some, length, 1.0)
    return length, [np.where(some, a / divisor, o) for a, o in zip(away, otherwise, strict=True)]


def across(axis: Axes) -> Axes:
    """A unit vector across a unit vector (Duff et al., Journal of Computer Graphics Techniques 6 (2017))."""
    a, b, c = axis
    sign = np.where(c < 0, -1.0, 1.0)
    s = -1.0 / (sign + c)
    return [1.0 + sign * a * a * s, sign * a * b * s, -1.0 * sign * a]


def axes_of(vectors: Array) -> Axes:
    """Vectors (..., d) as d arrays (...)."""
    return [vectors[..., i] for i in range(vectors.shape[-1])]


def vectors_of(axes: Axes, like: Array) -> Array:
    """The reverse of `axes_of`, in the shape of an array."""
    vectors = np.empty_like(like, order="C")
    for i, entries in enumerate(axes):
        vectors[..., i] = entries
    return vectors


def downwards(gravity: Array, dimension: int) -> Array:
    """A single number g [m/s^2] as a vector along the vertical axis; others as they are.

    Along a line a list of one number is such a vector already, and points upwards where it is positive.

    Raises:
        InputError: for a list of one number where there are more axes.
    """
    if gravity.ndim == 1 and len(gravity) == 1 != dimension:
        raise InputError(f"gravity is a list of one number: expected a number, or one for each of {dimension} axes")
    if gravity.ndim > 0:
        return gravity
    vector = np.zeros(dimension)
    vector[vertical_axis(dimension)] = -float(gravity.item())
    return vector


def vertical_axis(dimension: int) -> int:
    """The axis that points upwards: the second; along a line, the one there is."""
    return min(1, dimension - 1)
