"""The angle at a mass between two others: its size, and which way it grows. Needs NumPy only."""

from __future__ import annotations

import numpy as np

from reference.checked_springs import IntArray
from reference.state import Array


def arms_of(positions: Array, masses: IntArray) -> tuple[Array, Array]:
    """From the middle mass b of each three (a, b, c) to a and to c [m], positions (..., n, d): (..., k, d) each."""
    a, b, c = masses.T
    middle = positions[..., b, :]
    return positions[..., a, :] - middle, positions[..., c, :] - middle


def angles_between(first: Array, last: Array) -> Array:
    """From the first arm to the last [rad], arms (..., d): in the plane counter-clockwise, -pi to pi; in space 0 to pi.

    From sine and cosine together, so that it is good to rounding also where the arms are in line.
    """
    cosine = np.einsum("...i,...i->...", first, last)
    in_plane = first.shape[-1] == 2
    sine = _turn(first, last) if in_plane else np.linalg.norm(np.cross(first, last), axis=-1)
    angle: Array = np.arctan2(sine, cosine)
    return angle


def sideways(first: Array, last: Array) -> tuple[Array, Array, Array]:
    """Unit vectors across the arms, in their plane, the way the angle grows from the first to the last: e and f.

    Moving the end of the first arm along e makes the angle smaller, the end of the last along f larger. And the normal
    n of the plane they turn in, e = n x u: zero in the plane, where there is one plane only. Arms in line in space have
    no certain plane: any is taken that they are in.
    """
    lengths = (np.linalg.norm(arm, axis=-1, keepdims=True) for arm in (first, last))
    u, w = (arm / length for arm, length in zip((first, last), lengths, strict=True))
    if first.shape[-1] == 2:
        return _quarter_turn(u), _quarter_turn(w), np.zeros_like(u)
    normal = np.cross(u, w)
    size = np.linalg.norm(normal, axis=-1, keepdims=True)
    # across the axis that the arm is least along
    least = np.where(np.arange(3) == np.argmin(np.abs(u), axis=-1)[..., None], 1.0, 0.0)
    any_normal = np.cross(u, least)
    any_normal = any_normal / np.linalg.norm(any_normal, axis=-1, keepdims=True)
    with np.errstate(invalid="ignore", divide="ignore"):
        normal = np.where(size > 0, normal / size, any_normal)
    return np.cross(normal, u), np.cross(normal, w), normal


def _turn(first: Array, last: Array) -> Array:
    """The third component of first x last, of vectors of the plane."""
    third: Array = first[..., 0] * last[..., 1] - first[..., 1] * last[..., 0]
    return third


def _quarter_turn(vectors: Array) -> Array:
    """Vectors of the plane, turned by a right angle counter-clockwise."""
    return np.stack([-vectors[..., 1], vectors[..., 0]], axis=-1)
