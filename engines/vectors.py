"""Vectors of the plane, for engines that know space only. Needs NumPy only."""

from __future__ import annotations

import numpy as np

from reference.state import Array


def three(vector: Array) -> tuple[float, ...]:
    """Its numbers, with zeros for the axes it does not have.

    >>> three(np.array([1.0, -9.81]))
    (1.0, -9.81, 0.0)
    """
    return tuple(np.pad(vector, (0, 3 - len(vector))).tolist())
