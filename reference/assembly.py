"""Matrices of a mesh of springs: one small block per spring, assembled and solved as one system of equations.

Implicit schemes, equilibria and eigenfrequencies need the derivatives of the forces. The force of spring j between
masses a and b depends on their difference only, so one (d, d) block B_j says it all: it enters the matrix as
+B_j at (a, b) and (b, a), and -B_j at (a, a) and (b, b). An angular spring depends on the two arms from its middle
mass, and one (2 d, 2 d) block says it all.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from reference.errors import SolverError
from reference.jit import compiled
from reference.lengths import divisors
from reference.springs.angular import AngularSprings
from reference.springs.angular_law import derivatives
from reference.springs.linear_law import force_by_rate, spring_force
from reference.springs.nonlinear_law import damping_at, secant_stiffness, stretches, tangent_stiffness
from reference.state import Array, State
from reference.system import BoolArray, IntArray, MassSpringSystem

#: Up to this many unknowns a dense solve is quicker than a sparse one.
DENSE_UP_TO = 200

#: From ITERATE_FROM unknowns on, ROUNDS rounds of an iteration are tried before a matrix is made. They do where masses
#: weigh more than what springs do in a step, as with all steps that explicit schemes can take.
ITERATE_FROM, ROUNDS = 60, 40

#: What a solution may leave of the right side, as a part of it: rounding.
REMAINDER = 1e-14


@dataclass(frozen=True, eq=False)
class Blocks:
    """The derivative of the forces by positions or velocities.

    Attributes:
        springs: B_j, shape (s, d, d): how the force on a spring's first mass grows with its second mass's move.
        masses: shape (n,): how the force on a mass falls with its own move, alike in all directions (drag).
        angles: of the angular springs, shape (k, 2 d, 2 d): how the forces on the first and the last mass grow with the
            arms to them; a single zero where there are none, or they have no part.
    """

    springs: Array
    masses: Array
    angles: Array = field(default_factory=lambda: np.zeros((1, 1, 1)))

    @classmethod
    def of_masses(cls, system: MassSpringSystem, value: float) -> Blocks:
        """The same value for every mass, and nothing for the springs."""
        d = system.dimension
        return cls(np.zeros((len(system.springs), d, d)), np.full(len(system.masses), value))

    def __rmul__(self, factor: float) -> Blocks:
        return Blocks(factor * self.springs, factor * self.masses, factor * self.angles)

    def __add__(self, other: Blocks) -> Blocks:
        return Blocks(self.springs + other.springs, self.masses + other.masses, self.angles + other.angles)


def spring_blocks(system: MassSpringSystem, state: State) -> tuple[Blocks, Blocks]:
    """The exact derivatives of the forces at a state, by positions [N/m] and by velocities [N s/m].

    For a spring of length L along u, with w the velocity of its second mass less that of its first and F the force
    of the law of a spring, f = F(L - L0, u.w) u, so with the law's derivatives

        df/dw = F_rate u u^T
        df/dx = F_stretch u u^T + (F / L) (1 - u u^T) + (F_rate / L) u (w - (u.w) u)^T.
    """
    a, b = system.springs.T
    separation = state.positions[b] - state.positions[a]
    w = state.velocities[b] - state.velocities[a]
    length = np.linalg.norm(separation, axis=1)
    divisor = divisors(length, system.rest_lengths)
    u = separation / divisor[:, None]
    rate = np.einsum("si,si->s", u, w)
    stretch = length - system.rest_lengths
    damping = damping_at(system, stretch)
    secant = secant_stiffness(system, stretch)
    force = spring_force(secant, stretch, damping, rate)
    # where a spring of rest length 0 has no length, F / L is still its stiffness
    over_length = np.where(divisor == length, force / divisor, secant)
    by_rate = force_by_rate(damping)
    along = _outer(u, u)
    across = np.eye(system.dimension) - along
    turning = _outer(u, w - rate[:, None] * u)
    by_velocity = by_rate[:, None, None] * along
    by_position = (
        tangent_stiffness(system, stretch)[:, None, None] * along
        + over_length[:, None, None] * across
        + (by_rate / divisor)[:, None, None] * turning
    )
    return as_blocks(system, state, by_position, by_velocity)


def as_blocks(system: MassSpringSystem, state: State, by_position: Array, by_velocity: Array) -> tuple[Blocks, Blocks]:
    """The derivatives of the springs' forces, (s, d, d) each, with those of drag and of what resists bending."""
    nothing = np.zeros(len(system.masses))
    position = Blocks(by_position, nothing)
    if system.angular_springs is not None:
        position = replace(position, angles=derivatives(system.angular_springs, state.positions))
    return position, Blocks(by_velocity, nothing + system.drag)


def damping_of(system: MassSpringSystem, state: State) -> Array:
    """The damping that springs have at a state [N s/m], shape (s,): what is slack has none."""
    if system.nonlinear is None:
        return system.damping
    return damping_at(system, stretches(system, state.positions))


def damping_blocks(system: MassSpringSystem, state: State, coefficients: Array) -> Blocks:
    """How the damping of springs with these coefficients, shape (s,), answers velocities: B_j = c_j u u^T."""
    a, b = system.springs.T
    separation = state.positions[b] - state.positions[a]
    u = separation / divisors(np.linalg.norm(separation, axis=1), system.rest_lengths)[:, None]
    return Blocks(coefficients[:, None, None] * _outer(u, u), np.zeros(len(system.masses)))


def assemble(system: MassSpringSystem, blocks: Blocks, sparse: bool | None = None) -> Any:
    """The blocks as a matrix over the free masses' coordinates, shape (m d, m d).

    A NumPy array where that is small, else a SciPy sparse matrix; `sparse` insists on one of them.
    """
    d, n = system.dimension, len(system.masses)
    size = (n - int(np.count_nonzero(system.fixed))) * d
    if sparse if sparse is not None else size > DENSE_UP_TO:
        return _sparse(system, blocks)
    index, matrix = np.empty(n, dtype=np.int64), np.zeros((size, size))
    _add_blocks(system.fixed, system.springs, blocks.springs, blocks.masses, index, matrix)
    if system.angular_springs is not None:
        i, j = _pairs(index[system.angular_springs.masses])
        kept = (i >= 0) & (j >= 0)
        of_three = _of_three(system.angular_springs, blocks.angles, d)
        np.add.at(matrix.reshape(-1, d, size // d, d).swapaxes(1, 2), (i[kept], j[kept]), of_three[kept])
    return matrix


def add_blocks(
    fixed: BoolArray, springs: IntArray, of_springs: Array, of_masses: Array, index: IntArray, out: Array
) -> None:
    """Add blocks to a dense matrix of zeros, those of one place in the order in which `_sparse` has them.

    Args:
        index: written, where each mass is among the free ones; -1 for fixed ones.
    """
    d, free = of_springs.shape[1], 0
    for i in range(len(fixed)):
        index[i] = -1 if fixed[i] else free
        free += 0 if fixed[i] else 1
    for end in range(2):
        for j in range(len(springs)):
            a, b = index[springs[j, end]], index[springs[j, 1 - end]]
            for axis in range(d):
                for other in range(d):
                    if a >= 0:
                        out[a * d + axis, a * d + other] -= of_springs[j, axis, other]
                    if a >= 0 and b >= 0:
                        out[a * d + axis, b * d + other] += of_springs[j, axis, other]
    for i in range(len(fixed)):
        for axis in range(d):
            if not fixed[i]:
                out[index[i] * d + axis, index[i] * d + axis] -= of_masses[i]


def _sparse(system: MassSpringSystem, blocks: Blocks) -> Any:
    """The same as a SciPy sparse matrix; entries of one place are added in their order."""
    from scipy.sparse import coo_array

    n, d = system.positions.shape
    free = np.flatnonzero(~system.fixed)
    index = np.full(n, -1)
    index[free] = np.arange(len(free))
    a, b = index[system.springs.T]
    own = np.arange(len(free))
    i, j = np.concatenate([a, b, a, b, own]), np.concatenate([b, a, a, b, own])
    values = [blocks.springs, blocks.springs, -blocks.springs, -blocks.springs]
    values.append(-blocks.masses[free, None, None] * np.eye(d))
    if system.angular_springs is not None:
        of_angles = _pairs(index[system.angular_springs.masses])
        i, j = np.concatenate([i, of_angles[0]]), np.concatenate([j, of_angles[1]])
        values.append(_of_three(system.angular_springs, blocks.angles, d))
    kept, axes = (i >= 0) & (j >= 0), np.arange(d)
    rows = np.broadcast_to((i[kept, None] * d + axes)[:, :, None], (kept.sum(), d, d)).ravel()
    columns = np.broadcast_to((j[kept, None] * d + axes)[:, None, :], (kept.sum(), d, d)).ravel()
    entries = np.concatenate(values)[kept].ravel()
    return coo_array((entries, (rows, columns)), shape=(len(free) * d, len(free) * d)).tocsc()


def _pairs(three: IntArray) -> tuple[IntArray, IntArray]:
    """Of three masses each, shape (k, 3), the two of each of nine blocks, row by row: shape (9 k,) each."""
    return np.repeat(three, 3), np.tile(three, 3).ravel()


def _of_three(springs: AngularSprings, angles: Array, d: int) -> Array:
    """Blocks of angular springs over their arms, as blocks between their masses a, b, c, row by row: shape (9 k, d, d).

    A move of b shortens both arms, and the force on b is what is left of the other two.
    """
    k = len(springs.masses)
    arms = np.kron([[1.0, -1.0, 0.0], [0.0, -1.0, 1.0]], np.eye(d))
    whole = arms.T @ np.broadcast_to(angles, (k, 2 * d, 2 * d)) @ arms
    return whole.reshape(k, 3, d, 3, d).transpose(0, 1, 3, 2, 4).reshape(-1, d, d)


def solve_velocities(system: MassSpringSystem, blocks: Blocks, right: Array) -> Array:
    """The velocities v with (M - B) v = M r to rounding, shape (n, d); zero for fixed masses.

    Args:
        blocks: B, the derivative of the forces times a time.
        right: r, velocities too, shape (n, d); or many of them at once, shape (n, d, columns).

    Raises:
        SolverError: if there is no such velocity.
    """
    free = ~system.fixed
    if not free.any():
        return np.zeros_like(right)
    many = right.ndim == 3
    size = int(np.count_nonzero(free)) * system.dimension
    # the iteration knows blocks of springs only
    large = size >= ITERATE_FROM and not many and system.angular_springs is None
    found = _by_iteration(system, blocks, right) if large else None
    if found is not None:
        return found
    result = np.zeros_like(right)
    if size <= DENSE_UP_TO and not many and system.angular_springs is None:
        matrix, momentum = np.zeros((size, size)), np.empty(size)
        index, rows = np.empty(len(system.masses), dtype=np.int64), np.ascontiguousarray(right, np.float64)
        _write_equations(
            *(system.fixed, system.springs, blocks.springs, blocks.masses, system.masses, rows),
            *(index, matrix, momentum),
        )
        result[free] = _dense_solution(matrix, momentum).reshape(-1, system.dimension)
        return result
    mass = np.repeat(system.masses[free], system.dimension)
    matrix = assemble(system, -1.0 * blocks)
    momentum = (mass * right[free].reshape(size, *right.shape[2:]).T).T
    if isinstance(matrix, np.ndarray):
        matrix.flat[:: size + 1] += mass  # the diagonal
        solution = _dense_solution(matrix, momentum)
    else:
        from scipy.sparse import diags_array
        from scipy.sparse.linalg import spsolve

        # the pattern is symmetric: of SuperLU's orders the one made for such leaves half of the work
        solution = spsolve((matrix + diags_array(mass)).tocsc(), momentum, permc_spec="MMD_AT_PLUS_A")
    result[free] = solution.reshape(right[free].shape)
    return result


def _dense_solution(matrix: Array, momentum: Array) -> Array:
    try:
        return np.asarray(np.linalg.solve(matrix, momentum))
    except np.linalg.LinAlgError:
        raise SolverError("the system of equations for the velocities is singular") from None


def write_equations(
    fixed: BoolArray,
    springs: IntArray,
    of_springs: Array,
    of_masses: Array,
    masses: Array,
    right: Array,
    index: IntArray,
    matrix: Array,
    momentum: Array,
) -> None:
    """Write M - B to a matrix of zeros, and M r to the momentum, for the free masses; index as in `add_blocks`."""
    add_blocks(fixed, springs, of_springs, of_masses, index, matrix)
    for row in range(len(matrix)):
        for column in range(len(matrix)):
            matrix[row, column] = -matrix[row, column]
    d = right.shape[1]
    for i in range(len(fixed)):
        if not fixed[i]:
            for axis in range(d):
                row = index[i] * d + axis
                matrix[row, row] += masses[i]
                momentum[row] = masses[i] * right[i, axis]


def _by_iteration(system: MassSpringSystem, blocks: Blocks, right: Array) -> Array | None:
    """What solve_velocities asks for by BiCGSTAB (van der Vorst 1992), no matrix made; None if ROUNDS are too few."""
    from scipy.sparse.linalg import LinearOperator, bicgstab

    shape, free = right.shape, ~system.fixed
    weights = system.masses + blocks.masses
    springs_diagonal = np.einsum("sii->si", blocks.springs)
    diagonal = np.repeat(weights[:, None], system.dimension, axis=1)
    for end in system.springs.T:
        np.add.at(diagonal, end, springs_diagonal)
    inverse = 1 / diagonal.ravel()

    def product(v: Array) -> Array:
        out = np.empty(shape)
        _matrix_vector_product(v.reshape(shape), system.springs, blocks.springs, weights, free, out)
        return out.ravel()

    momentum = np.where(free[:, None], system.masses[:, None] * right, 0.0).ravel()
    # of size 1, as SciPy takes numbers that are small as such for the end of all rounds
    size = np.linalg.norm(momentum) or 1.0
    matrix, guess = (LinearOperator(2 * (right.size,), m) for m in (product, lambda v: inverse * v.ravel()))
    found, _ = bicgstab(matrix, momentum / size, rtol=REMAINDER / 10, maxiter=ROUNDS, M=guess)
    left = np.linalg.norm(product(found) - momentum / size)
    return size * found.reshape(shape) if left <= REMAINDER else None


def matrix_vector_product(
    v: Array, springs: IntArray, blocks: Array, weights: Array, free: BoolArray, out: Array
) -> None:
    """Write (M - B) v to out, for fixed masses without springs. The weights are M and what B has of masses."""
    for i in range(len(v)):
        for axis in range(v.shape[1]):
            out[i, axis] = weights[i] * v[i, axis]
    for j in range(len(springs)):
        a, b = springs[j, 0], springs[j, 1]
        for axis in range(v.shape[1]):
            force = 0.0
            for other in range(v.shape[1]):
                force += blocks[j, axis, other] * (v[b, other] - v[a, other])
            if free[a]:
                out[a, axis] -= force
            if free[b]:
                out[b, axis] += force


(_matrix_vector_product,) = compiled(matrix_vector_product)
_add_blocks, _write_equations = compiled(add_blocks, write_equations)


def _outer(u: Array, w: Array) -> Array:
    return u[:, :, None] * w[:, None, :]
