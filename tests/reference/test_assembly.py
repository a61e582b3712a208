"""The matrices of a mesh: derivatives of the forces against differences of them, and the equations they make."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given

from reference import assembly
from reference.assembly import Blocks, assemble, damping_blocks, solve_velocities, spring_blocks
from reference.errors import SolverError
from reference.forces import SpringMotion
from reference.state import Array, State
from reference.system import MassSpringSystem
from tests.reference.systems import meshes, moving_string, property_test, random_mesh

#: Gives the derivatives of the forces by positions and by velocities: the right ones, or wrong ones.
Derivatives = Callable[[MassSpringSystem, State], tuple[Blocks, Blocks]]


def differences(system: MassSpringSystem, by: str) -> Array:
    """The derivative of the free masses' forces by their positions or velocities, by differences, (m d, m d)."""
    motion, start = SpringMotion(system), system.start
    free = np.flatnonzero(~system.fixed)
    h = 1e-6
    columns = []
    for i in free:
        for axis in range(system.dimension):
            ends = []
            for sign in (1, -1):
                x, v = start.positions.copy(), start.velocities.copy()
                {"positions": x, "velocities": v}[by][i, axis] += sign * h
                ends.append(motion.acceleration(State(0.0, x, v)) * system.masses[:, None])
            columns.append(((ends[0] - ends[1]) / (2 * h))[free].ravel())
    return np.stack(columns, axis=1)


def check_derivatives(derivatives: Derivatives, system: MassSpringSystem) -> None:
    """dF/dx and dF/dv spring by spring are what differences of the forces say.

    Truncation is h^2 = 1e-12 of the third derivative, k/L^2 ~ 1e5 N/m^3; rounding eps F/h ~ 1e-9 N/m: both far below
    1e-6 of the stiffest spring.
    """
    for blocks, by in zip(derivatives(system, system.start), ("positions", "velocities"), strict=True):
        error = assemble(system, blocks, sparse=False) - differences(system, by)
        assert np.abs(error).max() < 1e-6 * system.stiffness.max()


@property_test
@given(system=meshes)
def test_blocks_are_the_derivatives_of_the_forces(system: MassSpringSystem) -> None:
    """On any mesh, damped springs in motion included."""
    check_derivatives(spring_blocks, system)


def without_turning(system: MassSpringSystem, state: State) -> tuple[Blocks, Blocks]:
    """Forgets that a spring in tension resists being turned: k u u^T alone."""
    _, by_velocity = spring_blocks(system, state)
    return damping_blocks(system, state, system.stiffness), by_velocity


def without_motion(system: MassSpringSystem, state: State) -> tuple[Blocks, Blocks]:
    """Forgets that the damping's force turns with the spring: derivatives taken at rest."""
    return spring_blocks(system, State(0.0, state.positions, np.zeros_like(state.velocities)))


def without_drag(system: MassSpringSystem, state: State) -> tuple[Blocks, Blocks]:
    """Forgets drag."""
    by_position, by_velocity = spring_blocks(system, state)
    return by_position, Blocks(by_velocity.springs, 0.0 * by_velocity.masses)


@pytest.mark.parametrize("derivatives", [without_turning, without_motion, without_drag])
def test_derivatives_fail_on_wrong_ones(derivatives: Derivatives) -> None:
    """Each forgotten part is seen."""
    with pytest.raises(AssertionError):
        check_derivatives(derivatives, random_mesh(4, 6, 3))


def random_blocks(system: MassSpringSystem) -> Blocks:
    """Minus something positive: what implicit schemes solve with."""
    by_position, by_velocity = spring_blocks(system, system.start)
    return 1e-3 * by_velocity + 1e-6 * by_position


def dense_solution(system: MassSpringSystem, blocks: Blocks, right: Array) -> Array:
    """(M - B) v = M r built entry by entry: B_j at (a, b) and (b, a), minus B_j at (a, a) and (b, b)."""
    n, d = system.positions.shape
    matrix = np.zeros((n, d, n, d))
    for (a, b), block in zip(system.springs.tolist(), blocks.springs, strict=True):
        matrix[a, :, b] -= block
        matrix[b, :, a] -= block
        matrix[a, :, a] += block
        matrix[b, :, b] += block
    for i in range(n):
        matrix[i, :, i] += (blocks.masses[i] + system.masses[i]) * np.eye(d)
    free = np.flatnonzero(~system.fixed)
    size = len(free) * d
    solution = np.zeros((n, d))
    reduced = matrix[free][:, :, free].reshape(size, size)
    solution[free] = np.linalg.solve(reduced, (system.masses[:, None] * right)[free].ravel()).reshape(-1, d)
    return solution


@property_test
@given(system=meshes)
def test_velocities_solve_their_equations(system: MassSpringSystem) -> None:
    """(M - B) v = M r, to rounding: the matrices here have condition numbers below 100."""
    blocks, right = random_blocks(system), np.random.default_rng(0).normal(size=system.positions.shape)
    solution = solve_velocities(system, blocks, right)
    assert np.abs(solution - dense_solution(system, blocks, right)).max() < 1e-12
    assert not solution[system.fixed].any()


def test_large_systems_are_solved_sparse_with_the_same_result() -> None:
    """150 masses in 2D are 300 unknowns: a sparse matrix, and the dense one's velocities to rounding."""
    system = moving_string(150, damping=0.1, drag=0.02)
    blocks, right = random_blocks(system), np.random.default_rng(0).normal(size=system.positions.shape)
    assert not isinstance(assemble(system, blocks), np.ndarray)
    solution = solve_velocities(system, blocks, right)
    assert np.abs(solution - dense_solution(system, blocks, right)).max() < 1e-12


def test_many_right_sides_are_solved_as_each_alone() -> None:
    """Of 40 masses, for which one alone is solved by iteration; a round of rounding apart."""
    system = moving_string(40, damping=0.1, drag=0.02)
    blocks, right = random_blocks(system), np.random.default_rng(0).normal(size=(41, 2, 3))
    solution = solve_velocities(system, blocks, right)
    for column in range(3):
        alone = solve_velocities(system, blocks, right[..., column])
        assert np.abs(solution[..., column] - alone).max() < 1e-12


def test_the_iteration_finds_what_a_matrix_gives() -> None:
    """And does find it: 40 masses, of which each falls otherwise with its own move."""
    system = moving_string(40, damping=0.1)
    blocks, rng = random_blocks(system), np.random.default_rng(0)
    blocks = Blocks(blocks.springs, rng.uniform(0.0, 0.02, 41))
    right = rng.normal(size=system.positions.shape)
    found = assembly._by_iteration(system, blocks, right)
    assert found is not None
    assert np.abs(found - dense_solution(system, blocks, right)).max() < 1e-12


def test_what_masses_have_of_their_own_is_on_the_diagonal() -> None:
    """Each its own, as arrays and sparse; of fixed masses nothing."""
    system = random_mesh(7, 8, 2, anchors=2)
    own = np.arange(1.0, 9.0)
    blocks = Blocks(np.zeros((len(system.springs), 2, 2)), own)
    for sparse in (False, True):
        matrix: Any = assemble(system, blocks, sparse=sparse)
        array = matrix.toarray() if sparse else matrix
        assert array.tolist() == np.diag(-np.repeat(own[2:], 2)).tolist()


@pytest.mark.parametrize("size", [1e-30, 1e30])
def test_velocities_of_any_size_are_solved_for(size: float) -> None:
    """As are those of 1 m/s: also by iteration, which is told when to end by a part of them."""
    system = moving_string(40, damping=0.1, drag=0.02)
    blocks, right = random_blocks(system), np.random.default_rng(0).normal(size=system.positions.shape)
    expected = solve_velocities(system, blocks, right)
    assert solve_velocities(system, blocks, size * right) / size == pytest.approx(expected, rel=1e-10, abs=1e-12)


@pytest.mark.parametrize("dimension", [2, 3])
def test_sparse_and_dense_matrices_are_equal(dimension: int) -> None:
    """The same entries, summed in the same places."""
    system = random_mesh(7, 8, dimension, anchors=2)
    for blocks in spring_blocks(system, system.start):
        dense: Any = assemble(system, blocks, sparse=False)
        assert np.abs(assemble(system, blocks, sparse=True).toarray() - dense).max() < 1e-12 * system.stiffness.max()


def test_a_singular_system_is_a_solver_error() -> None:
    """A pull that cancels a mass exactly leaves nothing to divide by."""
    system = moving_string(1)
    cancelling = Blocks(np.zeros((1, 2, 2)), -system.masses)
    with pytest.raises(SolverError, match="singular"):
        solve_velocities(system, cancelling, np.ones((2, 2)))
