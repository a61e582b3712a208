"""Matrices of a mesh of springs: one small block per spring, assembled and solved as one system of equations.

Implicit schemes, equilibria and eigenfrequencies need the derivatives of the forces. The force of spring j between
masses a and b depends on their difference only, so one (d, d) block B_j says it all: it enters the matrix as
+B_j at (a, b) and (b, a), and -B_j at (a, a) and (b, b).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from reference.errors import SolverError
from reference.state import Array, State
from reference.system import MassSpringSystem

#: Up to this many unknowns a dense solve is quicker than a sparse one.
DENSE_UP_TO = 200


@dataclass(frozen=True, eq=False)
class Blocks:
    """The derivative of the forces by positions or velocities.

    Attributes:
        springs: B_j, shape (s, d, d): how the force on a spring's first mass grows with its second mass's move.
        masses: shape (n,): how the force on a mass falls with its own move, alike in all directions (drag).
    """

    springs: Array
    masses: Array

    @classmethod
    def of_masses(cls, system: MassSpringSystem, value: float) -> Blocks:
        """The same value for every mass, and nothing for the springs."""
        d = system.dimension
        return cls(np.zeros((len(system.springs), d, d)), np.full(len(system.masses), value))

    def __rmul__(self, factor: float) -> Blocks:
        return Blocks(factor * self.springs, factor * self.masses)

    def __add__(self, other: Blocks) -> Blocks:
        return Blocks(self.springs + other.springs, self.masses + other.masses)


def spring_blocks(system: MassSpringSystem, state: State) -> tuple[Blocks, Blocks]:
    """The exact derivatives of the forces at a state, by positions [N/m] and by velocities [N s/m].

    For a spring of length L along u, with w the velocity of its second mass less that of its first,
    f = (k (L - L0) + c u.w) u, so

        df/dw = c u u^T
        df/dx = k u u^T + (f.u / L) (1 - u u^T) + (c / L) u (w - (u.w) u)^T.
    """
    a, b = system.springs.T
    gap = state.positions[b] - state.positions[a]
    w = state.velocities[b] - state.velocities[a]
    length = np.linalg.norm(gap, axis=1)
    u = gap / length[:, None]
    lengthening = np.einsum("si,si->s", u, w)
    force = system.stiffness * (length - system.rest_lengths) + system.damping * lengthening
    along = _outer(u, u)
    across = np.eye(system.dimension) - along
    turning = _outer(u, w - lengthening[:, None] * u)
    by_velocity = system.damping[:, None, None] * along
    by_position = (
        system.stiffness[:, None, None] * along
        + (force / length)[:, None, None] * across
        + (system.damping / length)[:, None, None] * turning
    )
    nothing = np.zeros(len(system.masses))
    return Blocks(by_position, nothing), Blocks(by_velocity, nothing + system.drag)


def damping_blocks(system: MassSpringSystem, state: State, coefficients: Array) -> Blocks:
    """How the damping of springs with these coefficients, shape (s,), answers velocities: B_j = c_j u u^T."""
    a, b = system.springs.T
    gap = state.positions[b] - state.positions[a]
    u = gap / np.linalg.norm(gap, axis=1)[:, None]
    return Blocks(coefficients[:, None, None] * _outer(u, u), np.zeros(len(system.masses)))


def assemble(system: MassSpringSystem, blocks: Blocks, sparse: bool | None = None) -> Any:
    """The blocks as a matrix over the free masses' coordinates, shape (m d, m d).

    A NumPy array where that is small, else a SciPy sparse matrix; `sparse` insists on one of them.
    """
    n, d = system.positions.shape
    free = np.flatnonzero(~system.fixed)
    index = np.full(n, -1)
    index[free] = np.arange(len(free))
    a, b = index[system.springs.T]
    own = blocks.masses[free, None, None] * np.eye(d)
    i = np.concatenate([a, b, a, b, np.arange(len(free))])
    j = np.concatenate([b, a, a, b, np.arange(len(free))])
    values = np.concatenate([blocks.springs, blocks.springs, -blocks.springs, -blocks.springs, -own])
    kept = (i >= 0) & (j >= 0)
    axes = np.arange(d)
    rows = np.broadcast_to((i[kept, None] * d + axes)[:, :, None], (kept.sum(), d, d)).ravel()
    columns = np.broadcast_to((j[kept, None] * d + axes)[:, None, :], (kept.sum(), d, d)).ravel()
    size = len(free) * d
    if sparse if sparse is not None else size > DENSE_UP_TO:
        from scipy.sparse import coo_array

        return coo_array((values[kept].ravel(), (rows, columns)), shape=(size, size)).tocsc()
    matrix = np.zeros((size, size))
    np.add.at(matrix, (rows, columns), values[kept].ravel())
    return matrix


def solve_velocities(system: MassSpringSystem, blocks: Blocks, right: Array) -> Array:
    """The velocities v with (M - B) v = M r, shape (n, d); zero for fixed masses.

    Args:
        blocks: B, the derivative of the forces times a time.
        right: r, velocities too, shape (n, d).

    Raises:
        SolverError: if there is no such velocity.
    """
    free = ~system.fixed
    mass = np.repeat(system.masses[free], system.dimension)
    matrix = assemble(system, -1.0 * blocks)
    momentum = mass * right[free].ravel()
    result = np.zeros_like(right)
    if isinstance(matrix, np.ndarray):
        matrix[np.diag_indices_from(matrix)] += mass
        try:
            solution = np.linalg.solve(matrix, momentum)
        except np.linalg.LinAlgError:
            raise SolverError("the system of equations for the velocities is singular") from None
    else:
        from scipy.sparse import diags_array
        from scipy.sparse.linalg import spsolve

        solution = spsolve((matrix + diags_array(mass)).tocsc(), momentum)
    result[free] = solution.reshape(-1, system.dimension)
    return result


def _outer(u: Array, w: Array) -> Array:
    return u[:, :, None] * w[:, None, :]
