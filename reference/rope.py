"""A rope: masses on rods, in the masses' own coordinates, on any mesh; and how MuJoCo keeps rods at their lengths.

`pendulum` has the angles of rods for its coordinates, so that no rod can stretch. Here a rod can, and its pull on the
two masses it joins is what keeps it from it. With J the matrix that makes of the masses' velocities the rates at which
rods lengthen, M the masses, a the acceleration that gravity and drag give them, the pulls p that make rods lengthen
with given accelerations are

    (J M^-1 J^T) p = (what is asked) - J a,      x'' = a + M^-1 J^T p.

A rod of length L that stays as long as it is asks for -|w|^2 / L, with w the difference of its ends' velocities across
it. (Baraff, SIGGRAPH 1996; Goldstein, *Classical Mechanics*, 1.3 and 2.4.)
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from reference.catalogue import Scheme
from reference.errors import InputError, SolverError
from reference.state import Array, Slope, State, Trajectory
from reference.system import BoolArray, MassSpringSystem

#: MuJoCo's impedance d of a rod, the largest there is; and R as a part of 1/m_a + 1/m_b, a thousandth of (1 - d)/d.
IMPEDANCE = 0.9999
GIVE = 1e-3 * (1 - IMPEDANCE) / IMPEDANCE

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
        rates: J v, at which they lengthen, shape (r,) [m/s].
        across: the squares of their ends' relative speeds across them, shape (r,) [m^2/s^2].
    """

    directions: Array
    lengths: Array
    rates: Array
    across: Array


class RopeMotion:
    """Equations of motion of a mesh whose springs have become rods.

    Args:
        system: any without obstacles. Where rods hold one another, more of them than can move, only `held` with some
            give is defined.

    Raises:
        InputError: for a system with obstacles.
    """

    def __init__(self, system: MassSpringSystem) -> None:
        if system.obstacles:
            raise InputError("no rope: expected no obstacles, which would push its masses off their rods")
        self.system = system
        self.start = system.start
        self._inverse = np.where(system.fixed, 0.0, 1 / system.masses)
        # a spring between two fixed masses holds nothing
        moved = ~system.fixed[system.springs].all(axis=1)
        self._ends = system.springs[moved].T
        self.rest_lengths = system.rest_lengths[moved]

    def rods(self, state: State) -> Rods:
        """Where the rods point, and how they lengthen."""
        a, b = self._ends
        gap, w = state.positions[b] - state.positions[a], state.velocities[b] - state.velocities[a]
        lengths = np.linalg.norm(gap, axis=1)
        u = gap / lengths[:, None]
        rates = (u * w).sum(axis=1)
        return Rods(u, lengths, rates, ((w - rates[:, None] * u) ** 2).sum(axis=1))

    def held(self, state: State, rods: Rods, asked: Array, give: float = 0.0) -> Array:
        """Accelerations of all masses [m/s^2], shape (n, d), with the pulls p that make J x'' = asked - R p.

        Args:
            asked: shape (r,) [m/s^2].
            give: R, as a part of the sum of the inverse masses of each rod's ends.

        Raises:
            SolverError: if there are no such pulls.
        """
        free = np.where(self.system.fixed[:, None], 0.0, self.system.gravity)
        free = free - self.system.drag * self._inverse[:, None] * state.velocities
        softness = give * self._inverse[self._ends].sum(axis=0)
        if give and len(rods.lengths) > DENSE_UP_TO:
            return self._held_sparse(free, rods, asked, softness)
        rows = self.rows(rods).reshape(len(rods.lengths), free.size)
        scaled = rows * np.repeat(self._inverse, free.shape[1])
        try:
            pulls = np.linalg.solve(scaled @ rows.T + np.diag(softness), asked - rows @ free.ravel())
        except np.linalg.LinAlgError:
            raise SolverError("rods that hold one another have no definite pulls") from None
        held: Array = free + (pulls @ scaled).reshape(free.shape)
        return held

    def rows(self, rods: Rods) -> Array:
        """J, shape (r, n, d)."""
        rows = np.zeros((len(rods.lengths), *self.start.positions.shape))
        rod, (a, b) = np.arange(len(rods.lengths)), self._ends
        rows[rod, b], rows[rod, a] = rods.directions, -rods.directions
        return rows

    def _held_sparse(self, free: Array, rods: Rods, asked: Array, softness: Array) -> Array:
        """The same for many rods, with y = x'' - a for the unknown: (M + J^T R^-1 J) y = J^T R^-1 (asked - J a).

        With little give R^-1 is large, and rounds away what M does: the remainders of M y = J^T p and
        J y + R p = asked - J a are solved for again.
        """
        from scipy.sparse import diags_array
        from scipy.sparse.linalg import splu

        movable = self._inverse > 0
        jacobian = self._sparse_rows(rods, movable)
        mass = np.repeat(1 / self._inverse[movable], free.shape[1])
        weighed = jacobian.T * (1 / softness)
        matrix = (diags_array(mass) + weighed @ jacobian).tocsc()
        factors = splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
        wanted = asked - jacobian @ free[movable].ravel()
        y, pulls = np.zeros(len(mass)), np.zeros(len(wanted))
        for _ in range(1 + REFINEMENTS):
            left, missing = jacobian.T @ pulls - mass * y, wanted - jacobian @ y - softness * pulls
            change = factors.solve(left + weighed @ missing)
            y, pulls = y + change, pulls + (missing - jacobian @ change) / softness
        held = free.copy()
        held[movable] += y.reshape(-1, free.shape[1])
        return held

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
        return self.held(state, rods, -rods.across / rods.lengths)

    def slope(self, state: State) -> Slope:
        """The rate of change of the whole state: velocities and accelerations."""
        return Slope(1.0, state.velocities, self.acceleration(state))

    def trajectory(self, states: list[State]) -> Trajectory:
        """The states of a run as the trajectory of the masses."""
        return Trajectory.of(states)


def rope_kick_drift(motion: RopeMotion, state: State, dt: float) -> State:
    """Kick-drift of masses on rods that are brought back to their lengths: MuJoCo's soft equality constraints.

    A rod that is r too long asks for -b J v - k r with b = 2 / (d T), k = 1 / (d T^2) and the time constant T = 2 dt.
    With d = 1 that is J v' = -r / (4 dt): no lengthening is left, and of r three quarters are left after the step.
    To first order it is the rods' true motion: their turning, which `asked` leaves out, costs some dt^2 of length.
    (MuJoCo's manual, *Computation*, "Constraint model".)
    """
    rods = motion.rods(state)
    damping, stiffness = 1 / (IMPEDANCE * dt), 1 / (4 * IMPEDANCE * dt**2)
    asked = -damping * rods.rates - stiffness * (rods.lengths - motion.rest_lengths)
    return state.kick(dt * motion.held(state, rods, asked, GIVE)).drift(dt)


#: On no other equations than a rope's, and so not among the schemes of springs.
ROPE_KICK_DRIFT = Scheme(rope_kick_drift, order=1, kind="engine_scheme", springs_only=False)
