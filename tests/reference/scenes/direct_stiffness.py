"""Structures by the textbook, owing nothing to the reference: direct stiffness, method of joints, a period off a run.

Direct stiffness (McGuire, Gallagher and Ziemian, *Matrix Structural Analysis* (2000), ch. 3): in the small-displacement
limit a bar of stiffness k along the unit vector n, between joints a and b, adds k n n^T to the structure's matrix at
(a, a) and (b, b) and takes it from (a, b) and (b, a); joints that are held lose their rows and columns.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.sparse import csc_array, diags_array
from scipy.sparse.linalg import eigsh, spsolve

from reference.state import Array, Trajectory
from reference.system import MassSpringSystem


def free_axes(system: MassSpringSystem) -> Array:
    """Which coordinates are free, shape (n d,), true or false."""
    return np.repeat(~system.fixed, system.dimension)


def stiffness_matrix(system: MassSpringSystem) -> Any:
    """K over the free coordinates, bar after bar."""
    d = system.dimension
    matrix = np.zeros((system.positions.size, system.positions.size))
    for (a, b), k in zip(system.springs.tolist(), system.stiffness.tolist(), strict=True):
        along = system.positions[b] - system.positions[a]
        along = along / np.sqrt(along @ along)
        ends = [*range(a * d, a * d + d), *range(b * d, b * d + d)]
        both = np.concatenate([-along, along])
        for i, row in enumerate(ends):
            for j, column in enumerate(ends):
                matrix[row, column] += k * both[i] * both[j]
    free = np.flatnonzero(free_axes(system))
    return csc_array(matrix[np.ix_(free, free)])


def mass_matrix(system: MassSpringSystem) -> Any:
    """M over the free coordinates: lumped at the joints."""
    return diags_array(np.repeat(system.masses, system.dimension)[free_axes(system)]).tocsc()


def deflection(system: MassSpringSystem) -> Array:
    """How far the weight moves the masses, shape (n, d) [m], from K u = M g."""
    weight = (system.masses[:, None] * system.gravity).ravel()
    moved = np.zeros(system.positions.size)
    moved[free_axes(system)] = spsolve(stiffness_matrix(system), weight[free_axes(system)])
    return moved.reshape(system.positions.shape)


def modes(system: MassSpringSystem, count: int) -> tuple[Array, Array]:
    """The lowest w^2 [1/s^2], rising, and their shapes, (count, n, d), from K q = w^2 M q."""
    start = np.random.default_rng(1).normal(size=int(free_axes(system).sum()))
    squares, vectors = eigsh(stiffness_matrix(system), count, mass_matrix(system), sigma=0.0, v0=start)
    shapes = np.zeros((count, system.positions.size))
    shapes[:, free_axes(system)] = vectors.T
    return squares, shapes.reshape(count, *system.positions.shape)


def bar_forces(system: MassSpringSystem, positions: Array) -> Array:
    """The tension of every spring [N], shape (s,): k (L - L0)."""
    a, b = system.springs.T
    lengths = np.linalg.norm(positions[b] - positions[a], axis=1)
    return np.asarray(system.stiffness * (lengths - system.rest_lengths))


def forces_by_joints(positions: Array, members: Array, loads: Array, pin: int, roller: int) -> tuple[Array, Array]:
    """Member forces [N], tension positive, and the reactions (pin x, pin y, roller y), by the method of joints.

    At every joint the pulls of its members, its load and its reaction sum to zero: 2 j equations for m forces and 3
    reactions, no stiffness in them. (Hibbeler, *Structural Analysis*, 3.4.)

    Args:
        positions: (j, 2) [m]. members: (m, 2). loads: (j, 2) [N]. pin: held in both axes. roller: held in the second.
    """
    count = len(members)
    equations = np.zeros((2 * len(positions), count + 3))
    for k, (a, b) in enumerate(members):
        toward = (positions[b] - positions[a]) / np.hypot(*(positions[b] - positions[a]))
        equations[2 * a : 2 * a + 2, k] = toward
        equations[2 * b : 2 * b + 2, k] = -toward
    equations[2 * pin, count] = equations[2 * pin + 1, count + 1] = equations[2 * roller + 1, count + 2] = 1.0
    solution = np.linalg.solve(equations, -loads.ravel())
    return solution[:count], solution[count:]


def measured_period(trajectory: Trajectory, rest: Array, shape: Array, masses: Array) -> float:
    """The period [s] of a mode, seen in a run: from its first to its last passage through rest.

    How much of the mode is in a state is its displacement projected on the shape; where that crosses zero is read off
    the cubic through the four nearest points.

    Args:
        rest: positions about which it swings, (n, d) [m]. shape: of the mode, (n, d). masses: (n,) [kg].
    """
    amount = np.einsum("tnd,nd,n->t", trajectory.positions - rest, shape, masses)
    passages = []
    for i in np.flatnonzero(np.signbit(amount[1:-2]) != np.signbit(amount[2:-1])) + 1:
        near = slice(i - 1, i + 3)
        cubic = np.polynomial.Polynomial.fit(trajectory.times[near], amount[near], 3)
        middle = (trajectory.times[i] + trajectory.times[i + 1]) / 2
        passages.append(min(cubic.roots(), key=lambda root: abs(root - middle)).real)
    return float(2 * (passages[-1] - passages[0]) / (len(passages) - 1))
