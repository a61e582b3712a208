"""Cloth, jello and girders, made of springs as long as they should be: small, rough, in motion, in space."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from engines.bullet.mesh import sorted_pairs, two_apart
from engines.bullet.softbody import in_space
from reference.state import Array
from reference.system import MassSpringSystem
from tests.conformance.case import Case


def on_springs(
    positions: Array,
    pairs: npt.ArrayLike,
    fixed: Sequence[int],
    *,
    stiffness: npt.ArrayLike = 50.0,
    damping: float = 0.0,
    drag: float = 0.0,
    velocities: npt.ArrayLike = 0.0,
) -> MassSpringSystem:
    """Masses of 10 g, springs as long as they should be."""
    springs = np.asarray(pairs)
    return MassSpringSystem(
        positions=positions,
        springs=springs,
        masses=np.array(0.01),
        rest_lengths=np.linalg.norm(positions[springs[:, 1]] - positions[springs[:, 0]], axis=1),
        stiffness=np.asarray(stiffness, dtype=float),
        damping=np.array(damping),
        drag=drag,
        gravity=np.array([0.0, 0.0, -9.81][3 - positions.shape[1] :]),
        velocities=np.asarray(velocities, dtype=float),
        fixed=np.isin(np.arange(len(positions)), fixed),
    )


def lattice(*sides: int) -> tuple[Array, npt.NDArray[np.int64]]:
    """A grid of points 0.1 m apart in space, shape (n, 3), and their numbers by place, shape `sides`."""
    places = np.indices(sides).reshape(len(sides), -1).T
    return in_space(0.1 * places), np.arange(len(places)).reshape(sides)


def cloth(side: int = 8, rough: float = 0.0, bends: bool = False, **more: object) -> MassSpringSystem:
    """Threads with one diagonal in each cell, and springs along two cells where there are bends; two corners fixed.

    Args:
        rough: how far points are off the grid, at random [m].
    """
    positions, at = lattice(side, side)
    pairs = [(at[1:], at[:-1]), (at[:, 1:], at[:, :-1]), (at[1:, 1:], at[:-1, :-1])]
    pairs += [(at[2:], at[:-2]), (at[:, 2:], at[:, :-2])] if bends else []
    springs = np.concatenate([np.column_stack([a.ravel(), b.ravel()]) for a, b in pairs])
    positions = positions + rough * np.random.default_rng(side).uniform(-1, 1, positions.shape)
    return on_springs(positions, springs, [0, side - 1], **more)  # type: ignore[arg-type]


#: Five corners of a cube of 0.1 m.
PLACES = lattice(2, 2, 2)[0][:5]

#: A cube as six tetrahedra round its diagonal: the corners met on each way from one end to the other.
WAYS = [(1, 3), (1, 5), (2, 3), (2, 6), (4, 5), (4, 6)]


def jello(side: int = 4, rough: float = 0.0, **more: object) -> MassSpringSystem:
    """Cubes of tetrahedra, whose edges are the springs; one face fixed."""
    positions, at = lattice(side, side, side)
    corners = [at[i : side - 1 + i, j : side - 1 + j, k : side - 1 + k] for i, j, k in np.ndindex(2, 2, 2)]
    tetrahedra = [(corners[0], corners[p], corners[q], corners[7]) for p, q in WAYS]
    pairs = {
        tuple(sorted(pair))
        for four in tetrahedra
        for i in range(4)
        for j in range(i)
        for pair in zip(four[i].ravel().tolist(), four[j].ravel().tolist(), strict=True)
    }
    positions = positions + rough * np.random.default_rng(side).uniform(-1, 1, positions.shape)
    return on_springs(positions, sorted(pairs), at[:, :, -1].ravel().tolist(), **more)  # type: ignore[arg-type]


def truss(bays: int = 6, **more: object) -> MassSpringSystem:
    """A girder in the plane, with both diagonals in every bay: its ends are fixed, and it swings to and fro."""
    at = np.arange(2 * bays + 2).reshape(-1, 2)
    pairs = [(at[1:, 0], at[:-1, 0]), (at[1:, 1], at[:-1, 1]), (at[:, 0], at[:, 1])]
    pairs += [(at[1:, 0], at[:-1, 1]), (at[1:, 1], at[:-1, 0])]
    springs = np.concatenate([np.column_stack(pair) for pair in pairs])
    positions = 0.1 * np.column_stack([np.repeat(np.arange(bays + 1), 2), np.tile([0.0, 1.0], bays + 1)])
    return on_springs(positions, springs, [0, 2 * bays], **more)  # type: ignore[arg-type]


def ladder(**more: object) -> MassSpringSystem:
    """Squares without diagonals: no three springs close a triangle."""
    whole = truss()
    return on_springs(whole.positions, whole.springs[:19], [0, 12], **more)  # type: ignore[arg-type]


def many_sided(triangles: Sequence[tuple[int, int, int]], **more: object) -> MassSpringSystem:
    """Triangles between points scattered in space, however many of them have a side in common; the first is fixed."""
    sides = {tuple(sorted(pair)) for a, b, c in triangles for pair in ((a, b), (b, c), (a, c))}
    scattered = np.random.default_rng(1).uniform(0.0, 0.5, (1 + max(map(max, triangles)), 3))
    return on_springs(scattered, sorted(sides), [0], **more)  # type: ignore[arg-type]


def lifted(system: MassSpringSystem) -> MassSpringSystem:
    """A system of the plane, turned out of it about the first axis."""
    turn = np.array([[1.0, 0.0, 0.0], [0.0, 0.8, 0.6]])
    flat = {name: getattr(system, name) @ turn for name in ("positions", "velocities", "gravity")}
    return replace(system, **flat)


def stiff_bends(system: MassSpringSystem, stiffness: float = 5.0) -> MassSpringSystem:
    """The same with springs between all masses two springs apart."""
    more = sorted(two_apart(sorted_pairs(system, system.stiffness > 0)))
    springs = np.vstack([system.springs, more])
    each = np.where(np.arange(len(springs)) < len(system.springs), system.stiffness[0], stiffness)
    anchored = np.flatnonzero(system.fixed).tolist()
    return on_springs(system.positions, springs, anchored, stiffness=each, damping=float(system.damping[0]))


def shaken(system: MassSpringSystem, part: float = 0.03) -> MassSpringSystem:
    """The same in motion, and begun with its springs off their rest lengths by parts of 0.1 m."""
    rng = np.random.default_rng(7)
    free = ~system.fixed[:, None]
    shift = np.where(free, rng.uniform(-1, 1, system.positions.shape), 0.0)
    return replace(system, positions=system.positions + 0.1 * part * shift, velocities=shift[::-1] * free)


def random_cases(count: int) -> list[Case]:
    """Cloths and jellos of any size, roughness, damping, drag and fixed masses, some in motion."""
    cases = []
    for seed in range(count):
        rng = np.random.default_rng(seed)
        numbers = {"damping": rng.choice([0.0, 0.03]), "drag": rng.choice([0.0, 0.02])}
        build, most = ((cloth, 9), (jello, 5))[seed % 2]
        system = build(int(rng.integers(2, most)), rough=0.03, stiffness=rng.uniform(10, 200), **numbers)
        fixed = rng.random(len(system.masses)) < 0.1
        velocities = np.where(fixed[:, None], 0.0, rng.uniform(-1, 1, system.positions.shape))
        cases.append(Case(f"random {seed}", replace(system, fixed=fixed, velocities=velocities), 1e-3, 200))
    return cases
