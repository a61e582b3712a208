"""The growth factor of a step: by how much the worst perturbation grows in one, in the long run. Needs NumPy only."""

from __future__ import annotations

import numpy as np

from reference.state import Array

#: An eigenvalue this near to 1 is of motion that nothing resists.
UNRESISTED = 1e-6


def growth_factor(jacobian: Array) -> float:
    """The largest modulus of an eigenvalue of a step's Jacobian (its spectral radius, or amplification factor).

    Eigenvalues of 1 are left out. They are of motion that no force resists, which goes on as it is begun; they come in
    pairs, and rounding tears a pair apart by its own root. Never below 1 - UNRESISTED: no faster decay is told.
    """
    if not np.isfinite(jacobian).all():
        return np.inf
    values = np.linalg.eigvals(jacobian)
    return float(np.abs(values[np.abs(values - 1) > UNRESISTED]).max(initial=1.0 - UNRESISTED))
