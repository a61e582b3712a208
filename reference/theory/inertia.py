"""How many eigenvalues of a symmetric matrix are negative: counted from the signs of its pivots.

Sylvester's law of inertia: L D L^T has as many negative eigenvalues as D has negative entries (Golub and Van Loan,
*Matrix Computations* (2013), 4.4 and 8.1). Elimination without exchanges of rows gives D, of sparse matrices in little
more time than a solve. It is as sure as rounding lets it be: a matrix that is singular to rounding is no test.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from reference.jit import array, compiled
from reference.state import Array


def negative_eigenvalues(matrix: Any) -> int:
    """Of a symmetric matrix, sparse or an array.

    >>> from scipy.sparse import diags_array
    >>> negative_eigenvalues(diags_array([3.0, -1.0, 2.0]))
    1
    """
    return int((pivots(matrix) < 0).sum())


def pivots(matrix: Any) -> Any:
    """The pivots of elimination without exchanges, shape (m,), of a sparse matrix in an order that keeps it sparse.

    NaN if one is zero.
    """
    if isinstance(matrix, np.ndarray):
        left = np.array(matrix, dtype=np.float64, order="C")
        _eliminate(left)
        found = left.diagonal()
        return found if found.all() else np.full(len(left), np.nan)
    from scipy.sparse.linalg import splu

    size, _ = matrix.shape
    options = {"SymmetricMode": True, "Equil": False}
    try:
        done = splu(matrix.tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options)
    except RuntimeError:  # SuperLU: exactly singular
        return np.full(size, np.nan)
    return done.U.diagonal() if (done.perm_r == done.perm_c).all() else np.full(size, np.nan)


def eliminate(left: Array) -> None:
    """Gaussian elimination of a symmetric array, shape (m, m), in place: its diagonal is left with the pivots."""
    for k in range(len(left)):
        for i in range(k + 1, len(left)):
            if left[i, k] != 0.0:
                factor = left[i, k] / left[k, k]
                for j in range(k + 1, len(left)):
                    left[i, j] -= factor * left[k, j]


(_eliminate,) = compiled(eliminate, kinds={"left": array(2, written=True)})
