"""A rope: masses joined by distance constraints ("rods"), in the masses' own coordinates, on any mesh.

`pendulum` has the angles of rods for its coordinates, so that no rod can stretch. Here a rod can, and the force along
it is what keeps it from it. With J the constraint Jacobian, which makes of the masses' velocities the rates at which
rods get longer, M the masses, and a the acceleration by gravity and drag, the Lagrange multipliers p (the forces along
the rods) for target accelerations of the rods' lengths are

    (J M^-1 J^T) p = target - J a,      x'' = a + M^-1 J^T p.

A rod of length L that stays as long as it is has the target -|w|^2 / L, with w the difference of its ends' velocities
across it. (Baraff, SIGGRAPH 1996; Goldstein, *Classical Mechanics*, 1.3 and 2.4.)
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from reference.errors import InputError, SolverError
from reference.state import Array, Slope, State, Trajectory
from reference.system import BoolArray, MassSpringSystem

#: Up to this many rods a dense solve is quicker than a sparse one.
DENSE_UP_TO = 60

#: How often what rounding has left of a sparse solution is solved for again.
REFINEMENTS = 2


@dataclass(frozen=True, eq=False)
class Rods:
    """The rods at a state.

    Attributes:
        directions: from a rod's first mass to its second, shape (r, d): what J is made of.
        lengths: shape (r,) [m].
        rates: J v, at which they get longer, shape (r,) [m/s].
        across: the squares of their ends' relative speeds across them, shape (r,) [m^2/s^2].
    """

    directions: Array
    lengths: Array
    rates: Array
    across: Array


class RopeMotion:
    """Equations of motion of a mesh whose springs have become rods.

    Args:
        system: any without obstacles. Where rods hold one another, more of them than can move, only `constrained` with
            some compliance is defined.

    Raises:
        InputError: for a system with obstacles, or springs that are not linear.
    """

    def __init__(self, system: MassSpringSystem) -> None:
        if system.collisions is not None:
            raise InputError(
                "no rope: expected masses that do not collide, which would push one another off their rods"
            )
        if not system.rest_lengths.all():
            raise InputError("no rope: expected rest lengths > 0, a rod of none is no rod")
        if system.pulls.any():
            raise InputError("no rope: expected no force that pulls on a mass, its rods know none")
        if system.nonlinear is not None:
            raise InputError(f"no rope: rods have no {', '.join(system.nonlinear.asked)}")
        if system.angular_springs is not None:
            raise InputError("no rope: expected no springs that resist bending, its rods know none")
        if system.obstacles:
            raise InputError("no rope: expected no obstacles, which would push its masses off their rods")
        self.system = system
        self.start = system.start
        self._inverse = np.where(system.fixed, 0.0, 1 / system.masses)
        # a spring between two fixed masses holds nothing
        moved = ~system.fixed[system.springs].all(axis=1)
        self._ends = system.springs[moved].T
        self.rest_lengths = system.rest_lengths[moved]
        self._falling = np.where(system.fixed[:, None], 0.0, system.gravity)
        self._inverse_of_rods = self._inverse[self._ends].sum(axis=0)

    def rods(self, state: State) -> Rods:
        """Where the rods point, and at which rates they get longer."""
        a, b = self._ends
        gap, w = state.positions[b] - state.positions[a], state.velocities[b] - state.velocities[a]
        lengths = np.linalg.norm(gap, axis=1)
        u = gap / lengths[:, None]
        rates = (u * w).sum(axis=1)
        return Rods(u, lengths, rates, ((w - rates[:, None] * u) ** 2).sum(axis=1))

    def constrained(self, state: State, rods: Rods, target: Array, compliance: float = 0.0) -> Array:
        """Accelerations of all masses [m/s^2], shape (n, d), with the multipliers p that make J x'' = target - R p.

        Args:
            target: shape (r,) [m/s^2].
            compliance: R, as a part of the sum of the inverse masses of each rod's ends.

        Raises:
            SolverError: if there are no such multipliers.
        """
        free = self._falling - self.system.drag * self._inverse[:, None] * state.velocities
        softness = compliance * self._inverse_of_rods
        if compliance and len(rods.lengths) > DENSE_UP_TO:
            return self._constrained_sparse(free, rods, target, softness)
        rows = self.rows(rods).reshape(len(rods.lengths), free.size)
        scaled = rows * np.repeat(self._inverse, free.shape[1])
        try:
            multipliers = np.linalg.solve(scaled @ rows.T + np.diag(softness), target - rows @ free.ravel())
        except np.linalg.LinAlgError:
            raise SolverError("rods that hold one another have no definite multipliers") from None
        accelerations: Array = free + (multipliers @ scaled).reshape(free.shape)
        return accelerations

    def rows(self, rods: Rods) -> Array:
        """J, shape (r, n, d)."""
        rows = np.zeros((len(rods.lengths), *self.start.positions.shape))
        rod, (a, b) = np.arange(len(rods.lengths)), self._ends
        rows[rod, b], rows[rod, a] = rods.directions, -rods.directions
        return rows

    def _constrained_sparse(self, free: Array, rods: Rods, target: Array, softness: Array) -> Array:
        """The same for many rods, with y = x'' - a for the unknown: (M + J^T R^-1 J) y = J^T R^-1 (target - J a).

        With little compliance R^-1 is large, and rounds away what M does: the remainders of M y = J^T p and
        J y + R p = target - J a are solved for again.
        """
        from scipy.sparse import diags_array
        from scipy.sparse.linalg import splu

        movable = self._inverse > 0
        jacobian = self._sparse_rows(rods, movable)
        mass = np.repeat(1 / self._inverse[movable], free.shape[1])
        weighed = jacobian.T * (1 / softness)
        matrix = (diags_array(mass) + weighed @ jacobian).tocsc()
        factors = splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
        wanted = target - jacobian @ free[movable].ravel()
        y, multipliers = np.zeros(len(mass)), np.zeros(len(wanted))
        for _ in range(1 + REFINEMENTS):
            left, missing = jacobian.T @ multipliers - mass * y, wanted - jacobian @ y - softness * multipliers
            change = factors.solve(left + weighed @ missing)
            y, multipliers = y + change, multipliers + (missing - jacobian @ change) / softness
        accelerations = free.copy()
        accelerations[movable] += y.reshape(-1, free.shape[1])
        return accelerations

    def _sparse_rows(self, rods: Rods, movable: BoolArray) -> Any:
        """J over the coordinates of the masses that move, shape (r, m d)."""
        from scipy.sparse import coo_array

        r, d = rods.directions.shape
        place = np.where(movable, np.cumsum(movable) - 1, -1)[self._ends]
        columns = (place[:, :, None] * d + np.arange(d)).ravel()
        rows = np.broadcast_to(np.arange(r)[:, None], (2, r, d)).ravel()
        values = np.concatenate([-rods.directions, rods.directions]).ravel()
        kept = np.repeat(place.ravel() >= 0, d)
        shape = (r, int(movable.sum()) * d)
        return coo_array((values[kept], (rows[kept], columns[kept])), shape=shape).tocsr()

    def acceleration(self, state: State) -> Array:
        """Accelerations of all masses [m/s^2], shape (n, d), with rods that stay as long as they are."""
        rods = self.rods(state)
        return self.constrained(state, rods, -rods.across / rods.lengths)

    def slope(self, state: State) -> Slope:
        """The rate of change of the whole state: velocities and accelerations."""
        return Slope(1.0, state.velocities, self.acceleration(state))

    def state_of(self, state: State) -> State:
        """A state of the masses is one of its own."""
        return state

    def trajectory(self, states: list[State]) -> Trajectory:
        """The states of a run as the trajectory of the masses."""
        return Trajectory.of(states)
