"""Where a camera has to be to see a scene, and where it will move to: straight on, in 3D from above."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np

from reference.line import system_in_plane
from reference.obstacles import Obstacle
from reference.state import Array
from reference.system import MassSpringSystem

#: From the scene towards the camera, by dimension; a line goes upwards.
TOWARDS = {1: (0.0, 0.0, 1.0), 2: (0.0, 0.0, 1.0), 3: (0.5, 0.4, 1.0)}

#: The part of the picture that is filled; and things no higher than that part of their size are flat.
FILLED, FLAT = 0.9, 0.1

#: What is held flat will hang: by this part of its size below. And all things move about a little.
HANGS, ROOM = 0.8, 0.1


@dataclass(frozen=True)
class Window:
    """What a scene is seen through.

    Attributes:
        field_of_view: of its height [rad].
        aspect: its width over its height.
        covered: the part of its height, from below, with something before it.
    """

    field_of_view: float
    aspect: float
    covered: float = 0.0

    @property
    def tangents(self) -> Array:
        """Half of what is seen at a distance of 1: across, and up."""
        up = np.tan(self.field_of_view / 2)
        return np.array([up * self.aspect, up * (1 - self.covered)])


def camera(system: MassSpringSystem, shifts: Array, window: Window) -> tuple[Array, Array]:
    """The places of the camera and of what it looks at [m], each of shape (3,).

    Args:
        shifts: of the lanes, shape (lanes, 3) [m].
    """
    low, high = box(system)
    low, high = low + shifts.min(axis=0), high + shifts.max(axis=0)
    middle = (low + high) / 2
    back = np.array(TOWARDS[system.dimension])
    back /= np.linalg.norm(back)
    right = np.cross([0.0, 1.0, 0.0], back)
    right /= np.linalg.norm(right)
    up = np.cross(back, right)
    corners = np.array(list(product(*zip(low, high, strict=True)))) - middle
    near, across, upwards = (corners @ axis for axis in (back, right, up))
    wide, high_enough = FILLED * window.tangents
    # What is not covered has its middle at this part of half the height.
    centre = window.covered * np.tan(window.field_of_view / 2)
    distance = max(
        (np.abs(across) / wide + near).max(),
        ((upwards + near * (centre + high_enough)) / high_enough).max(),
        ((-upwards - near * (centre - high_enough)) / high_enough).max(),
    )
    middle = middle - centre * distance * up
    return middle + distance * back, middle


def side_by_side(system: MassSpringSystem, count: int, window: Window) -> Array:
    """Where lanes side by side go, so that they are as large as can be: their shifts, shape (count, 3) [m]."""
    low, high = box(system)
    size = (high - low)[:2]

    def room(columns: int) -> float:
        return float((window.tangents / (size * [columns, -(-count // columns)])).min())

    columns = max(range(1, count + 1), key=room)
    cells = [divmod(i, columns) for i in range(count)]
    return np.array([[column * size[0], -row * size[1], 0.0] for row, column in cells])


def box(system: MassSpringSystem) -> tuple[Array, Array]:
    """The lower and the upper corner of what there is to see [m], each of shape (3,).

    What is held by one mass swings to its other side, too. Obstacles that are not larger than the system are in it.
    """
    system = system_in_plane(system)
    more = (0, 3 - system.dimension)
    low, high = np.pad(system.positions.min(axis=0), more), np.pad(system.positions.max(axis=0), more)
    held = np.pad(system.positions[system.fixed], ((0, 0), more))
    if len(held) and high[1] - low[1] <= FLAT * system.size:
        low[1] -= HANGS * system.size
        if len(held) == 1:
            sides = [0, 2]
            other_low, other_high = 2 * held[0] - high, 2 * held[0] - low
            low[sides], high[sides] = np.minimum(low, other_low)[sides], np.maximum(high, other_high)[sides]
    for obstacle in system.obstacles:
        centre, radius = _round(obstacle)
        if radius <= system.size:
            low, high = np.minimum(low, centre - radius), np.maximum(high, centre + radius)
    return low - ROOM * system.size, high + ROOM * system.size


def _round(obstacle: Obstacle) -> tuple[Array, float]:
    """The middle and the radius of a round one; of others none that counts."""
    numbers = obstacle.to_dict()
    if "radius" not in numbers or "centre" not in numbers:
        return np.zeros(3), np.inf
    centre = np.array(numbers["centre"])
    return np.pad(centre, (0, 3 - len(centre))), float(numbers["radius"])
