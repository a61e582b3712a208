"""How many eigenvalues of a symmetric matrix are negative: counted from the signs of its pivots.

Sylvester's law of inertia: L D L^T has as many negative eigenvalues as D has negative entries (Golub and Van Loan,
*Matrix Computations* (2013), 4.4 and 8.1). Elimination without exchanges of rows gives D, of sparse matrices in little
more time than a solve. It is as sure as rounding lets it be: a matrix that is singular to rounding is no test.
"""

from __future__ import annotations

from typing import Any

import numpy as np


def negative_eigenvalues(matrix: Any) -> int:
    """Of a sparse symmetric matrix.

    >>> from scipy.sparse import diags_array
    >>> negative_eigenvalues(diags_array([3.0, -1.0, 2.0]))
    1
    """
    return int((pivots(matrix) < 0).sum())


def pivots(matrix: Any) -> Any:
    """The pivots of elimination without exchanges, in an order that keeps it sparse, shape (m,); NaN if one is zero."""
    from scipy.sparse.linalg import splu

    options = {"SymmetricMode": True, "Equil": False}
    try:
        done = splu(matrix.tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options)
    except RuntimeError:  # SuperLU: exactly singular
        return np.full(matrix.shape[0], np.nan)
    return done.U.diagonal() if (done.perm_r == done.perm_c).all() else np.full(matrix.shape[0], np.nan)
