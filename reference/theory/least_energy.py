"""The equilibrium of a large mesh: its energy goes downhill by sparse steps, then Newton's method to rounding.

A step s solves (K + mu) s = F with F the forces, K their derivative and mu [N/m] as much as it takes: with little of it
a step is Newton's, with much it is short and straight downhill. (Levenberg, Quart. Appl. Math. 2 (1944); Nocedal and
Wright, *Numerical Optimization* (2006), 4.1 for when to trust it.) Springs in compression would make K indefinite, and
downhill might be up: what they give across themselves is left out of it until the end is near.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from reference.assembly import Blocks, assemble, spring_blocks
from reference.conserved import energy
from reference.errors import SolverError
from reference.forces import SpringMotion
from reference.state import Array, State
from reference.system import MassSpringSystem

#: Downhill as long as a force is above this part of the weight; a few steps of Newton's do the rest.
NEAR = 1e-6

#: So many times its size: whatever goes further away is held by nothing.
FAR = 1e3

#: So many steps downhill; a cloth of 4,000 masses takes some hundred.
MOST_STEPS = 2_000


def least_energy(system: MassSpringSystem) -> State:
    """The state at rest where forces balance, reached downhill from the start. Of any size; memory as the springs.

    Raises:
        SolverError: if there is none in reach.
    """
    search = _Search(system)
    q = search.newton(search.downhill(system.positions[~system.fixed].ravel()))
    if not np.abs(search.force(q)).max() < force_tolerance(system, search.weight):
        raise SolverError("no equilibrium: the forces do not balance anywhere near the start")
    return search.at(q)


def force_tolerance(system: MassSpringSystem, weight: float) -> float:
    """What may be left of a force in balance [N]: a billionth of the weight, and what positions round by."""
    rounding = np.finfo(float).eps * float(np.abs(system.positions).max(initial=0.0) + system.size)
    return 1e-9 * weight + 8 * rounding * float(system.stiffness.max(initial=0.0))


class _Search:
    """The energy of a system over its free masses' coordinates, shape (free masses x d,)."""

    def __init__(self, system: MassSpringSystem) -> None:
        self._system = system
        self._motion = SpringMotion(system)
        self._free = ~system.fixed
        self.weight = float((system.masses[:, None] * np.abs(system.gravity)).sum()) or 1.0

    def at(self, q: Array) -> State:
        """The state at rest there."""
        positions = self._system.positions.copy()
        positions[self._free] = q.reshape(-1, self._system.dimension)
        return State(0.0, positions, np.zeros_like(positions))

    def force(self, q: Array) -> Array:
        """On the free masses [N]."""
        forces = self._motion.acceleration(self.at(q)) * self._system.masses[:, None]
        return np.asarray(forces[self._free].ravel())

    def downhill(self, q: Array) -> Array:
        """Coordinates where forces nearly balance, with less energy than those given."""
        start, mu = q, self.weight / self._system.size
        height = energy(self._system, self.at(q))
        for _ in range(MOST_STEPS):
            force = self.force(q)
            if np.abs(force).max() < NEAR * self.weight:
                break
            stiffness = self._stiffness(q, tension_only=True)
            step = _solve(stiffness, mu, force)
            promised = force @ step - step @ (stiffness @ step) / 2
            there = energy(self._system, self.at(q + step))
            kept = (height - there) / promised
            if kept > 0.1:
                q, height = q + step, there
            if np.abs(q - start).max() > FAR * self._system.size:
                raise SolverError("no equilibrium: some of the system falls for ever")
            mu *= 0.25 if kept > 0.5 else 1.0 if kept > 0.1 else 4.0
        return q

    def newton(self, q: Array) -> Array:
        """The same to rounding; a trace of mu lets what no force holds stay where it is."""
        for _ in range(30):
            stiffness = self._stiffness(q)
            change = _solve(stiffness, 1e-13 * abs(stiffness).max(), self.force(q))
            q = q + change
            if np.abs(change).max() < 1e-14 * self._system.size:
                break
        return q

    def _stiffness(self, q: Array, tension_only: bool = False) -> Any:
        blocks, _ = spring_blocks(self._system, self.at(q))
        if tension_only:
            blocks = Blocks(_without_compression(self._system, self.at(q), blocks.springs), blocks.masses)
        return -assemble(self._system, blocks, sparse=True)


def _without_compression(system: MassSpringSystem, state: State, springs: Array) -> Array:
    """The springs' blocks less what those shorter than at rest give across themselves: (F / L) (1 - u u^T)."""
    a, b = system.springs.T
    separation = state.positions[b] - state.positions[a]
    length = np.linalg.norm(separation, axis=1)
    u = separation / length[:, None]
    across = np.eye(system.dimension) - u[:, :, None] * u[:, None, :]
    pushing = np.minimum(system.stiffness * (1 - system.rest_lengths / length), 0.0)
    return np.asarray(springs - pushing[:, None, None] * across)


def _solve(matrix: Any, mu: float, right: Array) -> Array:
    from scipy.sparse import diags_array
    from scipy.sparse.linalg import splu

    # symmetric: a pattern that is kept so fills in less
    whole = (matrix + diags_array(np.full(len(right), mu))).tocsc()
    solved = splu(whole, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    return np.asarray(solved.solve(right))
