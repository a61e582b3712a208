"""How many eigenvalues are negative, counted by pivots: as dense eigenvalues have it, of arrays and sparse matrices."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.sparse import csc_array

from reference.theory.inertia import negative_eigenvalues, pivots


@pytest.mark.parametrize("seed", range(20))
def test_negative_eigenvalues_are_those_of_dense_eigenvalues(seed: int) -> None:
    """Sylvester's law of inertia, on random symmetric matrices with entries of which half are zero."""
    random = np.random.default_rng(seed)
    half = np.triu(random.normal(size=(12, 12)) * (random.random((12, 12)) < 0.5))
    matrix = half + half.T + (0.1 + 3 * (seed % 3 - 1)) * np.eye(12)
    expected = int((np.linalg.eigvalsh(matrix) < 0).sum())
    assert negative_eigenvalues(matrix) == negative_eigenvalues(csc_array(matrix)) == expected


def test_a_sparse_matrix_of_which_rows_would_be_exchanged_is_no_test() -> None:
    """Some of them, or all: two with nothing on the diagonal beside one that has."""
    matrix = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 2.0]])
    for one in (matrix, matrix[::-1, ::-1], matrix[:2, :2]):
        assert np.isnan(pivots(csc_array(one))).all()
        assert negative_eigenvalues(csc_array(one)) == 0


def test_a_matrix_whose_elimination_meets_a_zero_is_no_test() -> None:
    """Singular, or not to be eliminated in this order: nothing is counted. The array itself stays as it was."""
    for matrix in (np.array([[1.0, 1.0], [1.0, 1.0]]), np.array([[0.0, 1.0], [1.0, 0.0]])):
        before = matrix.copy()
        assert np.isnan(pivots(matrix)).all()
        assert negative_eigenvalues(matrix) == 0
        assert (matrix == before).all()
