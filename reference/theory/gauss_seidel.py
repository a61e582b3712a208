"""Sequential impulses as Gauss and Seidel's iteration: how much a round of them leaves undone."""

from __future__ import annotations

import numpy as np

from reference.schemes.implicit_damping import effective_masses, spring_directions
from reference.state import Array
from reference.system import MassSpringSystem


def convergence_factor(system: MassSpringSystem, dt: float) -> float:
    """By what a round multiplies what is missing, in the long run, while springs point as they do at the start.

    A round is one of Gauss and Seidel's iteration for the springs' impulses p, (A + D) p = -J v. A = J M^-1 J^T is what
    they do to one another's elongation rates; with its damping D the diagonal is 1 / (m' (1 - exp(-dt c / m'))), m' a
    spring's effective mass. The factor is the largest modulus of an eigenvalue of the iteration matrix L^-1 (L - A - D)
    with L the lower triangle (Golub and Van Loan, *Matrix Computations*, 11.2). Springs in line do most to one another.

    Args:
        dt: the step [s].
    """
    matrix = impulse_matrix(system, dt)
    lower = np.tril(matrix)
    return float(np.abs(np.linalg.eigvals(np.linalg.solve(lower, lower - matrix))).max())


def impulse_matrix(system: MassSpringSystem, dt: float) -> Array:
    """A + D [1/kg], shape (s, s): the change of each spring's elongation rate by a unit impulse in each other one."""
    count, (a, b) = np.arange(len(system.springs)), system.springs.T
    rates = np.zeros((len(system.springs), *system.positions.shape))
    rates[count, b] = spring_directions(system, system.start)
    rates[count, a] = -rates[count, b]
    rates[:, system.fixed] = 0.0
    matrix = np.einsum("jnd,knd,n->jk", rates, rates, 1 / system.masses)
    mass = effective_masses(system)
    matrix[count, count] = -1 / (mass * np.expm1(-dt * system.damping / mass))
    return np.asarray(matrix)
