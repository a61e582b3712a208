"""Scenes on a lattice: cloth (slides 18-22) and jello (slides 23-26). Masses at regular places, joined to those near.

A lattice is an array of the numbers of its masses, one axis for each direction it extends in; springs go from every
mass to the one some places on: (0, 1) is the next in the row, (1, 1) the one across the cell.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import product
from math import prod
from typing import Literal

import numpy as np

from reference.errors import InputError
from reference.obstacles import Plane
from reference.scenes import scene
from reference.scenes.parameters import PerItem, counted, each, not_below_zero
from reference.state import Array
from reference.system import IntArray, MassSpringSystem

#: More masses than that, with up to 13 springs each, would fill the memory.
MOST_MASSES = 2_000_000

#: How many places on along each axis.
Offset = tuple[int, ...]

#: Cloth's springs (Provot, Graphics Interface 1995): along the threads, across the cells, over one mass to the next.
THREADS: tuple[Offset, ...] = ((0, 1), (1, 0))
DIAGONALS: tuple[Offset, ...] = ((1, 1), (1, -1))
OVER_ONE: tuple[Offset, ...] = ((0, 2), (2, 0))

#: Jello's, to all 26 neighbours, each pair once: along the cells' edges, across their faces, through their bodies.
NEIGHBOURS: tuple[Offset, ...] = tuple(o for o in product((0, 1, -1), repeat=3) if o > (0, 0, 0))

#: The edges of the six tetrahedra that each cell falls into, all around its diagonal (1, 1, 1) (Freudenthal 1942).
TETRAHEDRA: tuple[Offset, ...] = tuple(o for o in NEIGHBOURS if min(o) >= 0)

#: What a block of jello is made of.
Cells = Literal["lattice", "tetrahedra"]


@scene(dt=1e-3, duration=0.5, slides="18-22")
def cloth(
    *,
    rows: int = 10,
    columns: int = 10,
    mass: PerItem = 0.002,
    rest_length: float = 0.06,
    stiffness: float = 40.0,
    shear: float = 40.0,
    bend: float = 40.0,
    damping: float = 0.0,
    drag: float = 0.0,
    gravity: float = 9.81,
    pinned: Literal["corners", "four_corners", "edge"] = "corners",
) -> MassSpringSystem:
    """A cloth of threads and the springs across them, let go flat and level, held by corners or by an edge.

    Mass (row, column) is number row * columns + column, at x = column * rest_length and z = row * rest_length.
    stiffness [N/m] is that of the threads, `shear` of both diagonals of each cell, `bend` of the springs over one mass
    to the next but one; without stiffness the last two are left out. mass is one number or one for each mass. Row 0 is
    the edge, and has the two corners that hold it.
    """
    not_below_zero(shear=shear, bend=bend)
    numbers = lattice(rows=rows, columns=columns)
    held = {"corners": numbers[0, [0, -1]], "four_corners": numbers[[0, 0, -1, -1], [0, -1, 0, -1]], "edge": numbers[0]}
    groups = [(THREADS, stiffness), (DIAGONALS, shear), (OVER_ONE, bend)]
    return of_lattice(numbers, (2, 0), rest_length, groups, mass, damping, drag, gravity, held[pinned])


@scene(dt=1e-3, duration=0.5, slides="23-26")
def jello(
    *,
    across: int = 4,
    high: int = 4,
    deep: int = 4,
    mass: PerItem = 0.01,
    rest_length: float = 0.03,
    stiffness: float = 80.0,
    diagonals: float = 80.0,
    damping: float = 0.0,
    drag: float = 0.0,
    gravity: float = 9.81,
    speed: float = 0.8,
    held: Literal["bottom", "top"] = "bottom",
    cells: Cells = "lattice",
) -> MassSpringSystem:
    """A block of jello, standing on a fixed bottom or hung by its top, pushed sideways and let go.

    It has across x high x deep masses along x, y and z, each joined to its 26 neighbours: with `stiffness` [N/m] along
    the edges of the cells, with `diagonals` [N/m] across their faces and through their bodies; or as tetrahedra, to the
    14 neighbours that share one with it. mass is one number or one for each mass. It starts as if it were sheared on,
    its free end at `speed` [m/s] along x, masses in between in proportion.
    """
    numbers = lattice(across=across, high=high, deep=deep)
    face = numbers[:, 0 if held == "bottom" else -1]
    groups = _jello_springs(cells, stiffness, diagonals)
    block = of_lattice(numbers, (0, 1, 2), rest_length, groups, mass, damping, drag, gravity, face.ravel())
    height = np.abs(block.positions[:, 1] - block.positions[face[0, 0], 1])
    velocities = np.outer(height / ((high - 1) * rest_length), [speed, 0.0, 0.0])
    return replace(block, velocities=velocities)


@scene(dt=1e-3, duration=0.5, slides="23-26")
def drop(
    *,
    across: int = 4,
    high: int = 4,
    deep: int = 4,
    mass: PerItem = 0.01,
    rest_length: float = 0.03,
    stiffness: float = 80.0,
    diagonals: float = 80.0,
    damping: float = 0.0,
    drag: float = 0.0,
    gravity: float = 9.81,
    height: float = 0.05,
    cells: Cells = "lattice",
) -> MassSpringSystem:
    """A block of jello, let go at rest above a hard floor without friction.

    It is that of the scene `jello`, held by nothing, its bottom `height` [m] above the floor.
    """
    not_below_zero(height=height)
    numbers = lattice(across=across, high=high, deep=deep)
    groups = _jello_springs(cells, stiffness, diagonals)
    block = of_lattice(numbers, (0, 1, 2), rest_length, groups, mass, damping, drag, gravity, numbers[:0].ravel())
    return replace(block, obstacles=(Plane((0.0, -height, 0.0), (0.0, 1.0, 0.0)),))


def lattice(**counts: int) -> IntArray:
    """The numbers of the masses of a lattice with so many along each axis, two at least.

    Raises:
        InputError: naming the count that is too small or too large.
    """
    for name, count in counts.items():
        counted(name, count, 2, MOST_MASSES)
    masses = prod(counts.values())
    if masses > MOST_MASSES:
        raise InputError(f"{' x '.join(counts)} = {masses:,} masses: expected at most {MOST_MASSES:,}")
    return np.arange(masses).reshape(*counts.values())


def springs_between(numbers: IntArray, offsets: Sequence[Offset]) -> IntArray:
    """The springs from every mass of a lattice to the one at each offset from it, where there is one, shape (s, 2)."""
    pairs = [np.zeros((0, 2), dtype=np.int64)]
    for offset in offsets:
        spans = list(zip(numbers.shape, offset, strict=True))
        here = numbers[tuple(slice(max(-o, 0), max(n - max(o, 0), 0)) for n, o in spans)]
        there = numbers[tuple(slice(max(o, 0), max(n - max(-o, 0), 0)) for n, o in spans)]
        pairs.append(np.stack([here.ravel(), there.ravel()], axis=1))
    return np.concatenate(pairs)


def places(shape: Sequence[int], axes: Sequence[int], dimension: int, spacing: float) -> Array:
    """Where the masses of a lattice are [m], shape (n, dimension), from the origin on along the given axes."""
    positions = np.zeros((prod(shape), dimension))
    positions[:, axes] = spacing * np.indices(shape).reshape(len(shape), -1).T
    return positions


def _jello_springs(cells: Cells, stiffness: float, diagonals: float) -> list[tuple[list[Offset], float]]:
    """Offsets with their stiffness [N/m]: the edges of the cells, then what goes across."""
    not_below_zero(diagonals=diagonals)
    offsets = NEIGHBOURS if cells == "lattice" else TETRAHEDRA
    edges = [o for o in offsets if sum(map(abs, o)) == 1]
    return [(edges, stiffness), ([o for o in offsets if o not in edges], diagonals)]


def of_lattice(
    numbers: IntArray,
    axes: Sequence[int],
    rest_length: float,
    groups: Sequence[tuple[Sequence[Offset], float]],
    mass: PerItem,
    damping: float,
    drag: float,
    gravity: float,
    held: IntArray,
) -> MassSpringSystem:
    """A lattice in space, unstretched and at rest, held at some masses. Groups are offsets with their stiffness."""
    groups = [group for group in groups if group[1] or group is groups[0]]
    springs = [springs_between(numbers, offsets) for offsets, _ in groups]
    lengths = [rest_length * float(np.linalg.norm(o)) for offsets, _ in groups for o in offsets]
    counts = [len(springs_between(numbers, [o])) for offsets, _ in groups for o in offsets]
    return MassSpringSystem(
        positions=places(numbers.shape, axes, 3, rest_length),
        springs=np.concatenate(springs),
        masses=each("mass", mass, numbers.size),
        rest_lengths=np.repeat(lengths, counts),
        stiffness=np.repeat([stiffness for _, stiffness in groups], [len(s) for s in springs]),
        damping=np.array(damping),
        drag=drag,
        gravity=np.array(gravity),
        fixed=np.isin(np.arange(numbers.size), held),
    )
