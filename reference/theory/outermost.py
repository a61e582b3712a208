"""The eigenvalue of a large step that lies furthest towards -1 and beyond, in a subspace of moves that grows.

A step that is nearly one whose S(h) is known (`definite`) turns nearly the same moves round. So the search starts from
the lowest eigenvectors of that S, and where the eigenvalue's own vector leaves the subspace, what is missing of it is
about S^-1 times the residual: Davidson's method (J. Comput. Phys. 17 (1975)) with S^-1 to precondition. Positions and
velocities are moved by the same moves, each on its own, as nothing is known of how they go together in the step.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from reference.errors import SolverError
from reference.state import Array
from reference.theory.definite import Definiteness

#: What a step of dt [s] makes of states (free positions, dt x velocities), shape (2 m, columns).
StepOfColumns = Callable[[float, Array], Array]

#: How many of the lowest eigenvectors it starts from, and how often moves are added to them at one dt at most.
FIRST, ROUNDS = 6, 40

#: To what the eigenvalue is found; and as a part of how far it is from -1; and what rounding leaves of its vector.
PRECISION, ROUGH, ROUNDING = 1e-10, 1e-2, 1e-12

#: S is taken so much below where it is singular, as a part of that dt.
BELOW = 1e-3


class Outermost:
    """A subspace of moves for one system and one scheme, at any dt near to where another scheme gives up.

    Args:
        step: of the linearised motion.
        near: S(h) of a scheme that it is near to.
        limit: the dt [s] at which that S is singular.
    """

    def __init__(self, step: StepOfColumns, near: Definiteness, limit: float) -> None:
        from scipy.sparse import csc_array
        from scipy.sparse.linalg import LinearOperator, eigsh, splu

        self._step, self._root = step, np.tile(np.sqrt(near.linear.mass), 2)[:, None]
        matrix = near.matrix((1 - BELOW) * limit)
        self._solve: Callable[[Array], Array] = splu(csc_array(matrix)).solve
        size, _ = matrix.shape
        inverse: Any = LinearOperator((size, size), self._solve, dtype=float)
        start = np.random.default_rng(0).normal(size=size)
        self._moves: Array = eigsh(matrix, FIRST, sigma=0.0, OPinv=inverse, v0=start)[1]

    def beyond(self, dt: float) -> float:
        """How far beyond -1 it lies; negative where it is not beyond.

        Raises:
            SolverError: where it is not found in ROUNDS.
        """
        whole, images = self._stepped(self._moves, dt)
        for _ in range(ROUNDS):
            values, vectors = np.linalg.eig(whole.T @ images)
            outermost = int(np.argmin(values.real))
            value, vector = values[outermost], vectors[:, outermost]
            left = images @ vector - value * (whole @ vector)
            # of eigenvalues that all but meet, as those of a step without damping do at -1, more is off than is left
            condition = float(np.linalg.norm(np.linalg.inv(vectors)[outermost]))
            if np.linalg.norm(left) <= max(ROUNDING, max(PRECISION, ROUGH * abs(value + 1)) / condition):
                return float(-value.real - 1)
            new = self._missing(left)
            self._moves = np.concatenate([self._moves, new], axis=1)
            more = self._stepped(new, dt)
            whole, images = (np.concatenate(both, axis=1) for both in ((whole, more[0]), (images, more[1])))
        raise SolverError(f"no eigenvalue near -1 was found in {ROUNDS} rounds, in a step of {dt:.4g} s")

    def _stepped(self, moves: Array, dt: float) -> tuple[Array, Array]:
        """The states that have such positions or such velocities, and what a step makes of them, by roots of masses."""
        whole = np.asarray(np.kron(np.eye(2), moves), dtype=np.float64)
        return whole, self._root * self._step(dt, whole / self._root)

    def _missing(self, left: Array) -> Array:
        """The moves that the subspace misses where this is left, orthogonal to it and to one another."""
        parts = np.stack([part for half in np.split(left, 2) for part in (half.real, half.imag)], axis=1)
        new = self._solve(parts[:, np.abs(parts).max(axis=0) > 0])
        new = new / np.linalg.norm(new, axis=0)
        for _ in range(2):
            new = new - self._moves @ (self._moves.T @ new)
        directions, sizes, _ = np.linalg.svd(new, full_matrices=False)
        return np.asarray(directions[:, sizes > 1e-8 * sizes.max()])
