"""The linearised equations of motion as a scheme sees them: it steps small perturbations of an equilibrium."""

from __future__ import annotations

from typing import Any

import numpy as np

from reference.assembly import DENSE_UP_TO, Blocks, assemble, spring_blocks
from reference.pendulum import PendulumMotion
from reference.state import Array, Slope, State
from reference.system import MassSpringSystem


class LinearMotion:
    """The equations of motion about an equilibrium, linearised: of many small perturbations at once, one per column.

    States have shape (n, d) or (n, d, columns), perturbations of the equilibrium and their rates. The matrices are
    dense up to DENSE_UP_TO coordinates, else sparse.
    """

    def __init__(self, system: MassSpringSystem, equilibrium: State) -> None:
        self.system, self._equilibrium = system, equilibrium
        self._blocks = spring_blocks(system, equilibrium)
        self._by_position, self._by_velocity = (_by_mass(system, blocks) for blocks in self._blocks)
        self._drag = np.where(system.fixed, 0.0, system.drag / system.masses)

    def acceleration(self, state: State, damping: bool = True) -> Array:
        """Of all masses; without the damping of the springs if so asked."""
        size = self._by_position.shape[0]
        moved = self._by_position @ state.positions.reshape(size, -1)
        if damping:
            moved = moved + self._by_velocity @ state.velocities.reshape(size, -1)
            return np.asarray(moved.reshape(state.positions.shape))
        drag = self._drag.reshape(-1, *(1,) * (state.velocities.ndim - 1))
        return np.asarray(moved.reshape(state.positions.shape) - drag * state.velocities)

    def placed(self, state: State) -> State:
        """Where springs have their directions: at rest, whatever the perturbations."""
        return self._equilibrium

    def jacobians(self, state: State) -> tuple[Blocks, Blocks]:
        """The derivatives of the forces by positions [N/m] and by velocities [N s/m], those at rest."""
        return self._blocks

    def acceleration_of(self, i: int, state: State) -> Array:
        """Of mass i alone."""
        d = state.positions.shape[1]
        of_mass = slice(i * d, i * d + d)
        x, v = (q.reshape(self._by_position.shape[0], -1) for q in (state.positions, state.velocities))
        rows = np.asarray(self._by_position[of_mass] @ x + self._by_velocity[of_mass] @ v)
        return rows if state.positions.ndim == 3 else rows[:, 0]

    def slope(self, state: State) -> Slope:
        """(1, x', x'')."""
        return Slope(1.0, state.velocities, self.acceleration(state))


class LinearPendulum:
    """Small swings of a pendulum about its rest, linearised: of many at once, one per column. States are of angles."""

    def __init__(self, motion: PendulumMotion, equilibrium: State) -> None:
        self._by_position, self._by_velocity = motion.derivatives_at_rest(equilibrium)

    def acceleration(self, state: State) -> Array:
        """Of all rods."""
        return np.asarray(self._by_position @ state.positions + self._by_velocity @ state.velocities)

    def slope(self, state: State) -> Slope:
        """(1, x', x'')."""
        return Slope(1.0, state.velocities, self.acceleration(state))


def _by_mass(system: MassSpringSystem, blocks: Blocks) -> Any:
    """The derivatives of all coordinates' accelerations, shape (n d, n d); zero for fixed masses."""
    free = np.flatnonzero(np.repeat(~system.fixed, system.dimension))
    mass = np.repeat(system.masses, system.dimension)[free]
    size = system.positions.size
    if size <= DENSE_UP_TO:
        dense = np.zeros((size, size))
        dense[np.ix_(free, free)] = (1 / mass)[:, None] * assemble(system, blocks, sparse=False)
        return dense
    from scipy.sparse import coo_array, diags_array

    of_free = (diags_array(1 / mass) @ assemble(system, blocks, sparse=True)).tocoo()
    return coo_array((of_free.data, (free[of_free.row], free[of_free.col])), shape=(size, size)).tocsr()
