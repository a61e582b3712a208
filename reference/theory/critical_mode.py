"""Why a step is limited where it is: the mode that grows first, how fast it swings, and which springs it strains."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from reference.lengths import divisors
from reference.schemes.catalogue import Scheme
from reference.state import Array
from reference.theory.definite import Definiteness, lowest_eigenvector
from reference.theory.linearisation import Linearisation
from reference.theory.step_coefficients import is_quadratic

#: So far beyond a limit, as a part of it, negative damping is seen.
SHORTLY = 1e-6


@dataclass(frozen=True, eq=False)
class CriticalMode:
    """The first mode that grows when steps are made longer.

    Attributes:
        shape: moves of the masses, the largest 1, shape (n, d).
        frequency: [Hz], of the undamped motion in that shape.
        shares: of the energy of the springs in it, each spring's part, shape (s,).
    """

    shape: Array
    frequency: float
    shares: Array

    @property
    def spring(self) -> int:
        """The spring with the largest part."""
        return int(np.argmax(self.shares))

    @property
    def springs(self) -> int:
        """How many springs it takes, the most strained first, for half of the energy: few, and it is a local mode."""
        return int(np.searchsorted(np.cumsum(np.sort(self.shares)[::-1]), 0.5) + 1)


def critical_mode(scheme: Scheme, linear: Linearisation, dt: float) -> CriticalMode:
    """The mode that limits a scheme at its limit dt [s].

    Of a step with symmetric matrices, the direction in which S(dt) vanishes, or in which its damping is negative beyond
    dt. Of others the fastest swing, which limits them where damping is weak.
    """
    if is_quadratic(scheme, linear.damped, linear.dragged):
        definite, beyond = Definiteness(scheme, linear, dt), (1 + SHORTLY) * dt
        matrix = definite.damping_matrix(beyond) if definite.has_negative_damping(beyond) else definite.matrix(dt)
    else:
        matrix = -linear.scaled_stiffness
    moves = lowest_eigenvector(matrix) / np.sqrt(linear.mass)
    square = float(moves @ (linear.stiffness @ moves)) / float(moves @ (linear.mass * moves))
    system = linear.system
    shape = np.zeros_like(system.positions)
    of_masses = linear.moves(moves)
    shape[~system.fixed] = of_masses.reshape(-1, system.dimension) / np.abs(of_masses).max()
    return CriticalMode(shape, float(np.sqrt(max(square, 0.0)) / (2 * np.pi)), _shares(linear, shape))


def _shares(linear: Linearisation, shape: Array) -> Array:
    """Each spring's part of the energy that stretching takes, k (u . dx)^2 / 2."""
    a, b = linear.system.springs.T
    x = linear.state.positions
    along = (x[b] - x[a]) / divisors(np.linalg.norm(x[b] - x[a], axis=1), linear.system.rest_lengths)[:, None]
    energy = linear.system.stiffness * ((shape[b] - shape[a]) * along).sum(axis=1) ** 2
    whole = float(energy.sum())
    return np.asarray(energy / whole if whole else energy)
