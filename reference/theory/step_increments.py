"""By how much a step changes a small perturbation: B = J - 1, and how far its eigenvalues lie beyond the unit circle.

In a short step J is nearly 1. Where a mode is hardly damped, what it loses in a step and what the scheme adds to it
both drown in the rounding of 1 long before they are equal. So B is found without ever adding it to 1, and of an
eigenvalue 1 + b of J the modulus is taken from b alone.
"""

from __future__ import annotations

import numpy as np

from reference.schemes.catalogue import Scheme
from reference.state import Array, Slope, State
from reference.theory.equilibria import Equilibrium
from reference.theory.layout import layout_of
from reference.theory.linear_motion import LinearMotion, LinearPendulum
from reference.theory.step_map import Complex, step_jacobian


def is_exact(scheme: Scheme, rest: Equilibrium) -> bool:
    """Whether B is found without J: of a linear scheme that asks for accelerations only, and motion linearised."""
    return rest.linear_motion is not None and scheme.linear and "accelerations" in scheme.needs


def step_increments(scheme: Scheme, rest: Equilibrium, dt: float) -> Array:
    """B over the free positions, dt x velocities, and what a multistep scheme remembers (`step_map.step_jacobian`).

    Raises:
        SolverError: as the scheme's step does.
    """
    if not is_exact(scheme, rest):
        jacobian = step_jacobian(scheme, rest, dt)
        return jacobian - np.eye(len(jacobian))
    assert rest.linear_motion is not None
    layout, _ = layout_of(scheme, rest, dt)
    n, nothing = layout.size, np.zeros((*rest.state.positions.shape, 2 * layout.size))
    given = np.concatenate([np.eye(n), np.zeros((n, n))], axis=1)
    state = layout.state(given, State(0.0, nothing, nothing, (nothing,) * layout.remembered))
    end = layout.vector(scheme.on(_InTwoParts(rest.linear_motion))(state, dt))
    # 1 / dt x dt is not 1 at every dt: from what it was, not from the identity matrix
    begin = layout.vector(state)
    return np.asarray((end[:, :n] - begin[:, :n]) + end[:, n:])


def increments_of_modes(increments: Array) -> Complex:
    """The eigenvalues b of B: by two-sided Rayleigh quotients, which are as good as B's products with vectors are.

    The part of B that forgets what is no longer remembered is as large as 1, and with it the error of eigenvalues that
    are found by turning all of B; not that of the quotients (Parlett, *The Symmetric Eigenvalue Problem* (1980), 11).
    """
    from scipy.linalg import eig

    values, left, right = eig(increments, left=True, right=True)
    along = (left.conj() * right).sum(axis=0)
    quotients = (left.conj() * (increments @ right)).sum(axis=0) / np.where(along == 0, 1.0, along)
    # two modes that are nearly one have no quotients of their own
    return np.asarray(np.where(np.abs(quotients - values) < 1e-3 * np.abs(values), quotients, values))


def growth_of(b: Complex) -> Array:
    """|1 + b| - 1, without adding b to 1.

    >>> growth_of(np.array([1e-20 + 0j, 1e-9j]))
    array([1.e-20, 5.e-19])
    """
    squared = 2 * b.real + b.real**2 + b.imag**2
    return np.asarray(squared / (1 + np.sqrt(np.maximum(1 + squared, 0.0))))


class _InTwoParts:
    """The linearised motion, for states whose columns come twice: what stays without forces, and what they have added.

    A linear scheme adds and multiplies the two alike. So the first never loses what is in the second.
    """

    def __init__(self, motion: LinearMotion | LinearPendulum) -> None:
        self._motion = motion

    def acceleration(self, state: State) -> Array:
        """All of it is what forces add."""
        added = self._motion.acceleration(_whole(state))
        return np.concatenate([np.zeros_like(added), added], axis=-1)

    def acceleration_of(self, i: int, state: State) -> Array:
        """Of mass i alone."""
        assert isinstance(self._motion, LinearMotion)  # no scheme that asks for this steps a pendulum
        added = self._motion.acceleration_of(i, _whole(state))
        return np.concatenate([np.zeros_like(added), added], axis=-1)

    def slope(self, state: State) -> Slope:
        """(1, x', x'')."""
        return Slope(1.0, state.velocities, self.acceleration(state))


def _whole(state: State) -> State:
    """Both parts together."""
    columns = state.positions.shape[-1] // 2
    x, v = (q[..., :columns] + q[..., columns:] for q in (state.positions, state.velocities))
    return State(state.time, x, v)
