"""Conjugate residuals: they solve, and they stop when they said they would."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from reference.schemes.conjugate_residual import conjugate_residual
from reference.state import Array
from tests.reference.systems import property_test, seeds


def problem(seed: int, size: int, condition: float = 100.0) -> tuple[Array, Array]:
    """A random symmetric positive definite matrix with eigenvalues from 1 to `condition`, and a right-hand side."""
    rng = np.random.default_rng(seed)
    q, _ = np.linalg.qr(rng.normal(size=(size, size)))
    matrix = (q * rng.uniform(1.0, condition, size)) @ q.T
    return (matrix + matrix.T) / 2, rng.normal(size=size)


def solve(matrix: Array, right: Array, tolerance: float = 1e-12, iterations: int = 300) -> Array:
    """By conjugate residuals, preconditioned by the diagonal."""
    diagonal = matrix.diagonal()
    return conjugate_residual(lambda x: matrix @ x, right, lambda r: r / diagonal, tolerance, iterations)


def residual(matrix: Array, right: Array, x: Array) -> float:
    """The largest component of P (b - A x), what the tolerance is of."""
    return float(np.abs((right - matrix @ x) / matrix.diagonal()).max())


@property_test
@given(seed=seeds, size=st.integers(1, 30))
def test_solves_random_positive_definite_systems(seed: int, size: int) -> None:
    """A x = b to the tolerance: |P (b - A x)| <= 1e-12, and with condition 100 within 1e-9 of a direct solution."""
    matrix, right = problem(seed, size)
    x = solve(matrix, right)
    assert residual(matrix, right, x) < 2e-12
    assert np.abs(x - np.linalg.solve(matrix, right)).max() < 1e-9


@property_test
@given(seed=seeds, tolerance=st.floats(1e-9, 1e-1))
def test_stops_at_the_tolerance_and_not_far_beyond(seed: int, tolerance: float) -> None:
    """The result is within the tolerance; one iteration less would not be."""
    matrix, right = problem(seed, 20)
    calls = 0

    def apply(x: Array) -> Array:
        nonlocal calls
        calls += 1
        return matrix @ x

    diagonal = matrix.diagonal()
    x = conjugate_residual(apply, right, lambda r: r / diagonal, tolerance, 300)
    assert residual(matrix, right, x) <= tolerance * (1 + 1e-6)
    # The first product precedes the iterations, each of which but the last makes one more.
    assert calls == 0 or residual(matrix, right, solve(matrix, right, tolerance, calls - 1)) > tolerance


def test_does_nothing_where_the_first_residual_is_small_enough() -> None:
    """Bullet's way: no damping at all below the tolerance."""
    matrix, right = problem(1, 5)
    assert not solve(matrix, 1e-9 * right, tolerance=1e-8).any()
    assert solve(matrix, 1e-6 * right, tolerance=1e-8).any()


def test_after_its_iterations_it_returns_the_best_it_had() -> None:
    """With 3 of 20 iterations, not solved but nearer than zero; with none, zero."""
    matrix, right = problem(2, 20)
    three = solve(matrix, right, iterations=3)
    assert 1e-6 < residual(matrix, right, three) < residual(matrix, right, np.zeros(20))
    assert not solve(matrix, right, iterations=0).any()


@pytest.mark.parametrize("seed", range(5))
def test_what_it_returns_never_gets_worse_with_more_iterations(seed: int) -> None:
    """The largest component rises now and then from one iteration to the next: the best so far is kept."""
    matrix, right = problem(seed, 30, condition=1e4)
    sizes = [residual(matrix, right, solve(matrix, right, 1e-14, n)) for n in range(1, 25)]
    assert all(later <= earlier * (1 + 1e-9) for earlier, later in pairwise(sizes))


def test_each_iteration_comes_nearer_in_the_norm_it_minimises() -> None:
    """Each minimises |b - A x| over a space that holds the one before (with P = 1; Saad 6.8): it can only fall."""
    matrix, right = problem(3, 20)
    xs = [conjugate_residual(lambda x: matrix @ x, right, lambda r: r, 0.0, n) for n in range(1, 15)]
    norms = [float(np.linalg.norm(right - matrix @ x)) for x in xs]
    assert all(after < before for before, after in pairwise(norms))


def test_is_exact_after_as_many_iterations_as_there_are_eigenvalues() -> None:
    """Three distinct eigenvalues: three iterations (Saad 6.8), to rounding."""
    rng = np.random.default_rng(4)
    q, _ = np.linalg.qr(rng.normal(size=(12, 12)))
    matrix, right = (q * np.repeat([1.0, 3.0, 9.0], 4)) @ q.T, rng.normal(size=12)
    x = conjugate_residual(lambda v: matrix @ v, right, lambda r: r, 1e-14, 3)
    assert np.abs(x - np.linalg.solve(matrix, right)).max() < 1e-13


@pytest.mark.parametrize("tolerance", [0.0, 1e-8])
def test_the_identity_is_solved_in_one_iteration(tolerance: float) -> None:
    """And a residual of exactly zero ends it, at any tolerance."""
    right = np.array([[1.0, 2.0], [3.0, 4.0]])
    x = conjugate_residual(lambda v: v, right, lambda r: r, tolerance)
    assert x.tolist() == right.tolist()


def test_zero_is_solved_by_zero() -> None:
    """In the right-hand side's shape."""
    assert conjugate_residual(lambda v: v, np.zeros((3, 2)), lambda r: r).shape == (3, 2)
