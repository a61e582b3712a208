"""What a scheme makes of one spring and of one drag in a step: found from its own definition, by one mass on a spring.

Of many schemes a step, with the velocities eliminated, is a quadratic in the step map's eigenvalue l with symmetric
matrices, and with coefficients of the system's own matrices:

    (A2 l^2 + A1 l + A0) q = 0,    A2 + A1 + A0 = h^2 K,    A2 = M + Q + kappa h^2 K,    A0 = A2 - E - epsilon h^2 K.

Q is the damping that the step takes implicitly, E all the damping in it, each the sum of what the scheme makes of every
spring alone and of every mass's drag alone. One mass tells them: of trace T and determinant D of its 2 x 2 step matrix,
A2 = h^2 k / (1 - T + D) and A0 = D A2. Whether a scheme is of this kind at all is tried on a few masses that share no
modes (`is_quadratic`); schemes of users are found out in the same way.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache, lru_cache
from typing import Any

import numpy as np

from reference.errors import InputError, SolverError, Unsupported
from reference.forces import SpringMotion
from reference.schemes.catalogue import Scheme
from reference.schemes.implicit_damping import effective_masses
from reference.state import Array
from reference.system import IntArray, MassSpringSystem
from reference.theory.equilibria import Equilibrium
from reference.theory.linearisation import Linearisation
from reference.theory.oscillators import step_matrices
from reference.theory.step_map import step_jacobian

#: To which part of themselves the roots of the quadratic and the eigenvalues of a step agree, if it is one.
AGREEMENT = 1e-7


@dataclass(frozen=True, eq=False)
class StepCoefficients:
    """Of many independent oscillators, one entry each.

    Attributes:
        implicit: q [kg], what the step takes of the damping implicitly.
        all: e [kg], all damping in it.
        implicit_stiffness: kappa, the part of h^2 K in A2.
        damping_stiffness: epsilon, the part of h^2 K that damps.
    """

    implicit: Array
    all: Array
    implicit_stiffness: float
    damping_stiffness: float

    def of(self, which: IntArray) -> StepCoefficients:
        """Of some of them, in another order or several times."""
        return replace(self, implicit=self.implicit[which], all=self.all[which])


@np.errstate(over="ignore", invalid="ignore", divide="ignore")
def coefficients(scheme: Scheme, dt: float, masses: Array, damping: Array, drag: float = 0.0) -> StepCoefficients:
    """Of masses [kg] on springs of their own with damping [N s/m], both shape (s,); or of each with a drag [N s/m].

    Raises:
        SolverError, Unsupported: as the scheme's step does.
    """
    (a2, stiffer_a2), (a0, stiffer_a0) = _leading(scheme, dt, masses, damping, drag, np.array([1.0, 2.0]))
    damped = np.abs(a2 - a0) / masses
    kappa = _shared((stiffer_a2 - a2) / masses, damped)
    epsilon = _shared(((stiffer_a2 - stiffer_a0) - (a2 - a0)) / masses, damped)
    return StepCoefficients(a2 - (1 + kappa) * masses, a2 - a0 - epsilon * masses, kappa, epsilon)


def _shared(values: Array, damped: Array) -> float:
    """The one number that all are, but for rounding; where they are not, the quadratic will not fit.

    Taken of what is damped least: where damping is an exponential of dt, rounding grows with its square.
    """
    return round(float(values[np.argmin(damped)]), 12) if len(values) else 0.0


def _leading(
    scheme: Scheme, dt: float, masses: Array, damping: Array, drag: float, parts: Array
) -> tuple[Array, Array]:
    """A2 and A0 [kg], shape (p, s), with springs of h^2 k = part x m: as soft as positions and velocities are alike."""
    shape = len(parts), len(masses)
    all_masses, all_damping = (np.broadcast_to(each, shape).ravel() for each in (masses, damping))
    stiffness = (parts[:, None] * masses / dt**2).ravel()
    step = step_matrices(scheme, dt, all_masses, stiffness, all_damping, drag)[:, :2, :2].reshape(*shape, 2, 2)
    trace = step[..., 0, 0] + step[..., 1, 1]
    determinant = step[..., 0, 0] * step[..., 1, 1] - step[..., 0, 1] * step[..., 1, 0]
    a2 = parts[:, None] * masses / (1 - trace + determinant)
    return a2, determinant * a2


@lru_cache(maxsize=256)
def is_quadratic(scheme: Scheme, damped: bool, dragged: bool) -> bool:
    """Whether the scheme's step is of this kind, on systems whose springs are damped, whose masses are dragged.

    Tried on a few masses and springs, all different, that share no modes: all eigenvalues of the step's Jacobian are
    roots of the quadratic, to AGREEMENT. A scheme that stops iterating early is not, however near it comes; without
    damping there is nothing to iterate for.
    """
    if (scheme.iterated and damped) or not scheme.one_step:
        return False
    system = odd_system(damped, dragged)
    rest = Equilibrium(SpringMotion(system), system.start, ~system.fixed, 1.0)
    dt = 0.08
    try:
        a2, a1, a0 = (m.toarray() for m in quadratic(scheme, Linearisation(system, system.start), dt))
        stepped = np.linalg.eigvals(step_jacobian(scheme, rest, dt))
    except (SolverError, Unsupported, InputError):
        return False
    one = np.eye(len(a2))
    with np.errstate(all="ignore"):
        companion = np.block([[0 * one, one], [-np.linalg.solve(a2, a0), -np.linalg.solve(a2, a1)]])
    if not np.isfinite(companion).all():
        return False
    roots = np.linalg.eigvals(companion)
    apart = np.abs(stepped[:, None] - roots[None, :])
    return bool(apart.min(axis=1).max() < AGREEMENT and apart.min(axis=0).max() < AGREEMENT)


def quadratic(scheme: Scheme, linear: Linearisation, dt: float) -> tuple[Any, Any, Any]:
    """(A2, A1, A0) of a system, sparse, shape (m, m)."""
    from scipy.sparse import diags_array

    made = damping_in_step(scheme, linear, dt)
    stiffness = dt**2 * linear.stiffness
    a2 = diags_array(linear.mass) + linear.along_springs(made.springs.implicit) + linear.on_masses(made.drag.implicit)
    slowed = linear.along_springs(made.springs.all) + linear.on_masses(made.drag.all)
    a2 = a2 + made.springs.implicit_stiffness * stiffness
    a0 = a2 - slowed - made.springs.damping_stiffness * stiffness
    return a2, stiffness - a2 - a0, a0


@cache
def solves_for_positions(scheme: Scheme) -> bool:
    """Whether a step takes stiffness implicitly, kappa > 0: its positions are the solution of equations."""
    if not is_quadratic(scheme, False, False):
        return scheme.implicit
    one = np.ones(1)
    return coefficients(scheme, 1.0, one, 0 * one).implicit_stiffness > 1e-9


@dataclass(frozen=True, eq=False)
class DampingInStep:
    """What a step makes of every spring's damping, entries of shape (s,), and of every mass's drag, shape (n,)."""

    springs: StepCoefficients
    drag: StepCoefficients


def damping_in_step(scheme: Scheme, linear: Linearisation, dt: float) -> DampingInStep:
    """Of a system's springs and masses, each alone."""
    system = linear.system
    masses, of_mass = np.unique(system.masses, return_inverse=True)
    if not len(system.springs):
        drag = coefficients(scheme, dt, masses, np.zeros(len(masses)), system.drag).of(of_mass.ravel())
        return DampingInStep(replace(drag, implicit=np.zeros(0), all=np.zeros(0)), drag)
    pairs, which = np.unique(np.stack([effective_masses(system), system.damping]), axis=1, return_inverse=True)
    springs = coefficients(scheme, dt, pairs[0], pairs[1]).of(which.ravel())
    if not system.drag:
        none = np.zeros(len(system.masses))
        return DampingInStep(springs, replace(springs, implicit=none, all=none))
    return DampingInStep(
        springs, coefficients(scheme, dt, masses, np.zeros(len(masses)), system.drag).of(of_mass.ravel())
    )


def odd_system(damped: bool, dragged: bool) -> MassSpringSystem:
    """Three masses between two corners, with springs that are all different, at rest; damping matters in a step."""
    positions = np.array([[0.0, 0.0], [1.9, -0.2], [1.0, 0.1], [0.4, 1.2], [1.5, 1.0]])
    springs = np.array([[0, 2], [1, 2], [2, 3], [0, 3], [2, 4], [1, 4], [3, 4]])
    return MassSpringSystem(
        positions=positions,
        springs=springs,
        masses=np.array([1.0, 1.0, 0.7, 1.3, 0.4]),
        rest_lengths=np.linalg.norm(np.diff(positions[springs], axis=1)[:, 0], axis=1),
        stiffness=np.array([90.0, 140.0, 60.0, 110.0, 75.0, 50.0, 80.0]),
        damping=np.array([4.0, 0.3, 6.0, 0.6, 1.7, 2.0, 9.0]) if damped else np.zeros(7),
        drag=0.85 if dragged else 0.0,
        gravity=np.array(0.0),
        fixed=np.array([True, True, False, False, False]),
    )
