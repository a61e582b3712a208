"""The obstacles of a system, as they are given: of the system's dimension, and with no free mass inside."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from reference.errors import InputError
from reference.obstacles.kinds import KINDS, obstacle_of
from reference.obstacles.obstacle import Obstacle
from reference.state import Array

#: A mass may start inside by this part of the system's size: a state that was projected out and rounded is a start too.
ROUNDING = 1e-9


def checked_obstacles(
    obstacles: Iterable[Any], positions: Array, fixed: npt.NDArray[np.bool_], size: float
) -> tuple[Obstacle, ...]:
    """The obstacles of a system, given as such or as `to_dict` has them.

    Raises:
        InputError: for one of another dimension, and for a free mass inside one by more than ROUNDING of the size [m].
    """
    if not isinstance(obstacles, list | tuple):
        raise InputError(f"obstacles = {obstacles!r}: expected a list of obstacles")
    found = []
    for i, given in enumerate(obstacles):
        made = obstacle_of(**given) if isinstance(given, Mapping) else given
        if not isinstance(made, Obstacle):
            raise InputError(f"obstacles[{i}] = {given!r}: expected one of {', '.join(KINDS)}")
        d = positions.shape[1]
        if made.dimension != d:
            raise InputError(f"obstacles[{i}] is a {made.kind} in {made.dimension}D: expected one in {d}D")
        with np.errstate(over="ignore", invalid="ignore"):
            distance, _ = made.signed_distances(positions)
        inside = np.flatnonzero((distance[:, 0] < -ROUNDING * size) & ~fixed)
        if len(inside):
            j = inside[0]
            raise InputError(
                f"positions[{j}] = {positions[j].tolist()}: expected a start outside the {made.kind} obstacles[{i}], "
                f"it is {-distance[j, 0]:.3g} m inside"
            )
        found.append(made)
    return tuple(found)
