"""Masses that rest on obstacles: which are pressed, how hard, and what that makes of small moves about the rest.

A contact that presses holds: without friction its mass moves along the surface only. There the obstacle's force N has a
part in how forces answer a move, as the surface curves: with g the signed distance and H its second derivative, the
stiffness of the springs K becomes K - N H (Nocedal and Wright, *Numerical Optimization* (2006), 12.5, the Hessian of
the Lagrangian on the tangent space of the active constraints).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from reference.obstacles import Obstacle, project_out
from reference.state import Array
from reference.system import IntArray, MassSpringSystem
from reference.theory.linearisation import Linearisation

#: How far apart normals are taken to see how a surface curves, as a part of the size of what rests on it.
APART = 1e-4


@dataclass(frozen=True, eq=False)
class Contacts:
    """All contacts that press, in the order of the obstacles.

    Attributes:
        masses: which mass, shape (c,).
        obstacles: on which of the system's obstacles, shape (c,).
        normals: outwards, shape (c, d).
        forces: on the masses along their normals [N], all > 0, shape (c,).
    """

    masses: IntArray
    obstacles: IntArray
    normals: Array
    forces: Array

    def __len__(self) -> int:
        return len(self.masses)

    def flat(self, system: MassSpringSystem) -> bool:
        """Whether all are on planes or on faces of boxes."""
        return all(not hasattr(system.obstacles[k], "radius") for k in self.obstacles)


@dataclass(frozen=True, eq=False)
class ContactLinearisation(Linearisation):
    """A system of springs about a rest on obstacles: its matrices are over moves along the surfaces alone.

    Attributes:
        contacts: what presses.
    """

    contacts: Contacts | None = None

    @cached_property
    def tangents(self) -> Any:
        """Directions that no contact bars, orthonormal, as columns: sparse, shape (free coordinates, m)."""
        assert self.contacts is not None
        blocks = []
        for i in np.flatnonzero(~self.system.fixed):
            barred = self.contacts.normals[self.contacts.masses == i]
            blocks.append(_across(barred, self.system.dimension))
        return block_diagonal(blocks).tocsr()

    @cached_property
    def mass(self) -> Array:
        """The diagonal of M [kg], shape (m,)."""
        whole = np.repeat(self.system.masses[~self.system.fixed], self.system.dimension)
        return np.asarray((self.tangents.T.multiply(self.tangents.T)) @ whole)

    @cached_property
    def stiffness(self) -> Any:
        """K - N H along the surfaces [N/m], sparse, shape (m, m)."""
        assert self.contacts is not None
        whole = super().stiffness - curving(self.system, self.state.positions, self.contacts)
        return (self.tangents.T @ whole @ self.tangents).tocsc()

    def along_springs(self, coefficients: Array) -> Any:
        """See Linearisation."""
        return self.tangents.T @ super().along_springs(coefficients) @ self.tangents

    def on_masses(self, coefficients: Array) -> Any:
        """See Linearisation."""
        return self.tangents.T @ super().on_masses(coefficients) @ self.tangents

    def array_of(self, springs: Array, masses: Array) -> Array:
        """See Linearisation."""
        return np.asarray(self.tangents.T @ super().array_of(springs, masses) @ self.tangents)

    def moves(self, along: Array) -> Array:
        """See Linearisation."""
        return np.asarray(self.tangents @ along)


def block_diagonal(blocks: Iterable[Array]) -> Any:
    """Blocks along the diagonal of a sparse array, in columns: newer SciPys would have it said which it is to be."""
    from scipy.sparse import block_diag, coo_array

    return block_diag([coo_array(block) for block in blocks], format="csc")


def curving(system: MassSpringSystem, positions: Array, contacts: Contacts) -> Any:
    """The sum of N H over the contacts [N/m], over the free masses' coordinates: sparse."""
    blocks = np.zeros((len(positions), system.dimension, system.dimension))
    for i, k, force in zip(contacts.masses, contacts.obstacles, contacts.forces, strict=True):
        blocks[i] += force * curvatures(system.obstacles[k], positions[i : i + 1], APART * system.size)[0]
    return block_diagonal(blocks[~system.fixed])


def curvatures(obstacle: Obstacle, positions: Array, apart: float) -> Array:
    """The second derivative H of the signed distance [1/m] at positions (n, d), shape (n, d, d): of its normals.

    Central differences of fourth order, from normals an apart [m] from each other: of a sphere of radius R they are
    true to (apart / R)^4.
    """

    def normals(shift: Array) -> Array:
        return obstacle.signed_distances(positions + shift)[1]

    axes = apart * np.eye(positions.shape[1])
    columns = [8 * (normals(e) - normals(-e)) - (normals(2 * e) - normals(-2 * e)) for e in axes]
    return np.stack(columns, axis=-1) / (12 * apart)


def projection_jacobian(system: MassSpringSystem, positions: Array, velocities: Array, dt: float) -> Array:
    """The derivative of the end of a step, `obstacles.project_out`, over z = (free positions, dt x velocities).

    With g < 0, x - g n has the derivative 1 - n n^T - g H, and v - (v.n) n has 1 - n n^T by v, and by x
    -(v.n) H - n (H v)^T, where v leads inwards; dense, shape (2 m, 2 m).

    Args:
        positions, velocities: before it, shape (n, d) [m], [m/s].
    """
    d, whole = system.dimension, np.eye(2 * system.dimension)
    blocks = np.tile(whole, (len(positions), 1, 1))
    x, v = positions, velocities
    for obstacle in system.obstacles:
        distance, normals = obstacle.signed_distances(x)
        inside = np.flatnonzero((distance[:, 0] < 0) & ~system.fixed)
        bent = curvatures(obstacle, x[inside], APART * system.size)
        for i, h in zip(inside, bent, strict=True):
            n, inwards = normals[i], float(v[i] @ normals[i])
            out, one = np.outer(n, n), np.array(whole)
            one[:d, :d] -= out + distance[i, 0] * h
            if inwards < 0:
                one[d:, d:] -= out
                one[d:, :d] -= dt * (inwards * h + np.outer(n, h @ v[i]))
            blocks[i] = one @ blocks[i]
        x, v = project_out((obstacle,), system.fixed[:, None], x, v)
    return _by_block(blocks[~system.fixed], d)


def _by_block(blocks: Array, d: int) -> Array:
    """Blocks over (x, dt v) of each mass as one matrix over all x, then all dt v."""
    n = len(blocks)
    whole = np.zeros((2, n, d, 2, n, d))
    each = np.arange(n)
    whole[:, each, :, :, each, :] = blocks.reshape(n, 2, d, 2, d)
    return whole.reshape(2 * n * d, 2 * n * d)


def _across(normals: Array, dimension: int) -> Array:
    """An orthonormal basis across some directions, as columns, shape (d, d - rank)."""
    if not len(normals):
        return np.eye(dimension)
    _, sizes, rows = np.linalg.svd(normals, full_matrices=True)
    return np.asarray(rows[int((sizes > 1e-9).sum()) :].T)
