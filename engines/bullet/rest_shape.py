"""Where Bullet finds the rest lengths: it measures them in its first step, on the positions it finds then."""

from __future__ import annotations

import numpy as np

from engines.engine import Unsupported
from reference.state import Array
from reference.system import MassSpringSystem

#: Rest lengths are met to this part of the system's size: to rounding.
MET = 1e-14

#: Newton steps before it is given up. From a shape nearby a handful do; towards a flat one, some tens.
STEPS = 50

#: The most masses that a shape is looked for, with dense matrices.
LARGEST = 600


def rest_shape(system: MassSpringSystem, guess: Array) -> Array:
    """Positions of the masses in space at which every spring has its rest length, shape (n, 3) [m].

    Args:
        guess: where to look first, shape (n, 3).

    Raises:
        Unsupported: where there is no such shape, or none near the guess.
    """
    if system.is_string:
        return _folded(system)
    if _missed(system, guess) <= MET * system.size:
        return guess
    if len(system.masses) > LARGEST:
        raise Unsupported(f"bullet_softbody cannot do springs off their rest lengths on more than {LARGEST} masses")
    return _found(system, guess)


def _folded(system: MassSpringSystem) -> Array:
    """A string folded on itself, from the origin.

    Folded, because 0, L, 0, L, ... are exactly L apart and 0, L, 2 L, 3 L, ... only to rounding.
    """
    there_and_back = np.where(np.arange(len(system.rest_lengths)) % 2 == 0, 1.0, -1.0)
    positions = np.zeros((len(system.positions), 3))
    positions[1:, 0] = np.cumsum(there_and_back * system.rest_lengths)
    return positions


def _found(system: MassSpringSystem, guess: Array) -> Array:
    """By Gauss and Newton: the smallest move that makes all springs as long as they should be, again and again."""
    a, b = system.springs.T
    rows = np.arange(len(system.springs))
    shape = guess
    for _ in range(STEPS):
        separation = shape[b] - shape[a]
        length = np.linalg.norm(separation, axis=1)
        missing = system.rest_lengths - length
        if not length.all() or not np.isfinite(missing).all():
            break
        if np.abs(missing).max() <= MET * system.size:
            return shape
        matrix = np.zeros((len(rows), len(shape), 3))
        matrix[rows, b] = separation / length[:, None]
        matrix[rows, a] = -matrix[rows, b]
        move = np.linalg.lstsq(matrix.reshape(len(rows), -1), missing, rcond=1e-10)[0]
        shape = shape + move.reshape(shape.shape)
    raise Unsupported(
        "bullet_softbody cannot do springs off their rest lengths where no shape of the mesh has them all: Bullet "
        "measures them on one"
    )


def _missed(system: MassSpringSystem, shape: Array) -> float:
    a, b = system.springs.T
    return float(np.abs(np.linalg.norm(shape[b] - shape[a], axis=1) - system.rest_lengths).max())
