"""A system that resists bending wherever two springs meet: a string becomes a wire. Needs NumPy only."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import numpy.typing as npt

from reference.checked_numbers import finite
from reference.checked_springs import IntArray
from reference.springs.angular import AngularSprings
from reference.system import MassSpringSystem


def with_bending(system: MassSpringSystem, stiffness: npt.ArrayLike) -> MassSpringSystem:
    """The system with angular springs as laid out at every mass where two springs meet, in place of any it has.

    Args:
        stiffness: [N m/rad], one number, or one for each, in the order of the masses they bend at; 0: as it was.

    Raises:
        InputError: as a system does.
    """
    bending = finite("bending", stiffness, "N m/rad")
    if not bending.any():
        return system
    masses = at_every_middle(system.springs, len(system.masses))
    return replace(system, angular_springs=AngularSprings(masses, bending))


def at_every_middle(springs: IntArray, count: int) -> IntArray:
    """Masses b that two springs meet at, with those at their other ends: (a, b, c), rising in b, a < c, shape (k, 3).

    Args:
        springs: the two masses each joins, shape (s, 2).
        count: how many masses there are.
    """
    ends = np.concatenate([springs, springs[:, ::-1]])
    middles = np.flatnonzero(np.bincount(ends[:, 0], minlength=count) == 2)
    met = ends[np.isin(ends[:, 0], middles)]
    a, c = met[np.lexsort(met.T[::-1]), 1].reshape(-1, 2).T
    three = np.stack([a, middles, c], axis=1)
    return three[a != c]
