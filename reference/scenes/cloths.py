"""Cloths that nothing holds, and a flag: a cloth falls onto a sphere, another over a table's edge; a flag in the wind.

Of slides 18-22 the springs, as in the scene `cloth`. A cloth's masses meet obstacles, its springs do not: one may cut
across an edge.
"""

from __future__ import annotations

from dataclasses import replace
from math import cos, radians, sin
from typing import Literal

import numpy as np

from reference.errors import InputError
from reference.obstacles import Box, Sphere
from reference.scenes import scene
from reference.scenes.lattices import DIAGONALS, OVER_ONE, THREADS, lattice, of_lattice
from reference.scenes.parameters import not_below_zero
from reference.state import Array
from reference.system import IntArray, MassSpringSystem

#: How far below a cloth that is let go an obstacle stands [m].
CLEARANCE = 0.02


@scene(dt=1e-3, duration=0.5, slides="16-17, 18-22")
def falling_cloth(
    *,
    rows: int = 10,
    columns: int = 10,
    mass: float = 0.002,
    rest_length: float = 0.06,
    stiffness: float = 40.0,
    shear: float = 40.0,
    bend: float = 0.0,
    damping: float = 0.02,
    drag: float = 0.0,
    gravity: float = 9.81,
    radius: float = 0.15,
) -> MassSpringSystem:
    """A cloth falls flat onto a sphere; nothing holds it.

    Springs are those of the scene `cloth`. The sphere has a `radius` [m], its top 2 cm below the middle of the cloth.
    """
    cloth = _level(rows, columns, mass, rest_length, [stiffness, shear, bend], damping, drag, gravity)
    x, y, z = cloth.positions.mean(axis=0)
    return replace(cloth, obstacles=(Sphere((x, y - CLEARANCE - radius, z), radius),))


@scene(dt=1e-3, duration=0.5, slides="16-17, 18-22")
def tablecloth(
    *,
    rows: int = 10,
    columns: int = 10,
    mass: float = 0.002,
    rest_length: float = 0.06,
    stiffness: float = 40.0,
    shear: float = 40.0,
    bend: float = 0.0,
    damping: float = 0.02,
    drag: float = 0.0,
    gravity: float = 9.81,
    overhang: float = 0.5,
) -> MassSpringSystem:
    """A cloth lies on a table with a part of it over the edge, and slides down: the table has no friction.

    Springs are those of the scene `cloth`. overhang is the part of its columns beyond the edge, between 0 and 1, along
    the first axis. The table is as wide as three cloths, and 0.2 m thick.
    """
    if not 0 < overhang < 1:
        raise InputError(f"overhang = {overhang:g}: expected a number between 0 and 1")
    cloth = _level(rows, columns, mass, rest_length, [stiffness, shear, bend], damping, drag, gravity)
    width, depth = np.ptp(cloth.positions[:, [0, 2]], axis=0)
    half = (1.5 * width, 0.1, 1.5 * depth)
    centre = ((1 - overhang) * width - half[0], -half[1], depth / 2)
    return replace(cloth, obstacles=(Box(centre, half),))


@scene(dt=1e-3, duration=0.5, slides="18-22")
def flag(
    *,
    rows: int = 8,
    columns: int = 12,
    mass: float = 0.002,
    rest_length: float = 0.05,
    stiffness: float = 40.0,
    shear: float = 10.0,
    bend: float = 2.0,
    damping: float = 0.0,
    drag: float = 0.004,
    gravity: float = 9.81,
    wind: float = 8.0,
    direction: float = 20.0,
    held: Literal["pole", "line"] = "pole",
) -> MassSpringSystem:
    """A flag in a steady wind, held along a pole or by its upper edge on a line.

    It starts flat and upright: columns along x, rows along y, the pole at x = 0. The wind blows level at `wind` [m/s],
    `direction` degrees from x towards z. Drag is relative to the air, -Cd (v - w) = -Cd v + Cd w with w the wind's
    velocity, and as all masses are equal Cd w is the weight of an added gravity Cd w/m: that is how it is built. On a
    line, with the wind square to it, the flag comes to rest as a plane at tan(angle) = Cd w/(m g) from the vertical.

    The limit: every mass feels the same air, whichever way the cloth is turned, and does not disturb it. So it settles;
    a real flag flutters on. A `gravity` that is changed on the fly is all there is from then on, and the wind has gone.
    """
    not_below_zero(shear=shear, bend=bend, wind=wind)
    numbers = lattice(rows=rows, columns=columns)
    ends = {"pole": numbers[:, 0], "line": numbers[-1]}[held]
    groups = [(THREADS, stiffness), (DIAGONALS, shear), (OVER_ONE, bend)]
    made = of_lattice(numbers, (1, 0), rest_length, groups, mass, damping, drag, gravity, ends)
    return replace(made, gravity=made.gravity + _blown(mass, drag, wind, direction))


def _blown(mass: float, drag: float, wind: float, direction: float) -> Array:
    """What wind adds to gravity, Cd w/m [m/s^2], shape (3,)."""
    return drag * wind / mass * np.array([cos(radians(direction)), 0.0, sin(radians(direction))])


def _level(
    rows: int,
    columns: int,
    mass: float,
    rest_length: float,
    stiffness: list[float],
    damping: float,
    drag: float,
    gravity: float,
) -> MassSpringSystem:
    """A level cloth that nothing holds; stiffness [N/m] of threads, diagonals, and springs over one mass."""
    not_below_zero(shear=stiffness[1], bend=stiffness[2])
    numbers: IntArray = lattice(rows=rows, columns=columns)
    groups = list(zip((THREADS, DIAGONALS, OVER_ONE), stiffness, strict=True))
    return of_lattice(numbers, (2, 0), rest_length, groups, mass, damping, drag, gravity, numbers[:0, 0])
