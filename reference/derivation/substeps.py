"""Steps that are made of several equal ones: a sub-step's matrix is a root of the whole one's.

A sub-step takes h/n, and multiplies (x, h v/n): with B its matrix and S = diag(1, n), a step is S B^n S^-1. Where B
follows small formulas in a/n^2, b/n and d/n, for an n, it is found by them; the step itself follows large ones only.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from reference.derivation.fit import ABOVE, Entries, Samples, formulas_of
from reference.state import Array

#: How many sub-steps are tried, the most first: of six, three pairs would follow formulas, too.
COUNTS = (20, 16, 12, 10, 8, 6, 5, 4, 3, 2)

#: Eigenvectors of a smaller condition number give roots to rounding; this part of matrices has to have such ones.
TOLD, MOST = 1e4, 0.9


def of_substeps(
    at: Samples, measured: Array, noise: float, counts: Sequence[int] = COUNTS, largest: int = ABOVE
) -> tuple[int, Entries] | None:
    """How many sub-steps a step is made of, and the formulas of one of them; None where it is none of these.

    Args:
        measured: step matrices, shape (n, 2, 2).
        noise: how far their entries are off by rounding.
        counts: how many are tried. largest: the largest power of h above that formulas may have.
    """
    if not np.isfinite(measured).all():
        return None
    values, vectors = np.linalg.eig(measured.astype(complex))
    told = np.linalg.cond(vectors) < TOLD  # there is no such root where it has one eigenvector, as critically damped
    if told.mean() < MOST:
        return None
    values, vectors = values[told], vectors[told]
    at = Samples(at.a[told], at.b[told], at.d[told])
    inverse = np.linalg.inv(vectors)
    for n in counts:
        # a sub-step turns less than half a turn: the root nearest to 1
        root = ((vectors * (values ** (1 / n))[:, None, :]) @ inverse).real
        root[:, 0, 1] *= n
        root[:, 1, 0] /= n
        entries = formulas_of(Samples(at.a / n**2, at.b / n, at.d / n), root, n * noise, largest)
        if entries is not None and all(entry.exact for entry in entries):
            return n, entries
    return None


def as_whole(one: Array, count: int) -> Array:
    """The matrices of whole steps, shape (..., 2, 2), from those of sub-steps."""
    whole = np.linalg.matrix_power(one, count)
    whole[..., 0, 1] /= count
    whole[..., 1, 0] *= count
    return whole
