"""Stability, predicted: how a scheme's step answers a small push, and up to which dt the answer dies away.

One step is a map z -> Phi(z) of the whole state. About an equilibrium a small push dz becomes J dz, J the Jacobian of
Phi; it dies away if all eigenvalues of J lie within the unit circle (Hairer and Wanner II, IV.2). This works for any
stepper that is a function, in-place variants included, and asks nothing about how it is made.
"""

from __future__ import annotations

import numpy as np

from reference.catalogue import Scheme
from reference.forces import SpringMotion
from reference.state import Array, State
from reference.system import MassSpringSystem

#: An eigenvalue this little over 1 is the rounding of the differences, not growth.
MARGIN = 1e-7


def step_jacobian(scheme: Scheme, system: MassSpringSystem, equilibrium: State, dt: float) -> Array:
    """J, shape (2 m d, 2 m d) over the m free masses' positions and dt x velocities, by central differences.

    Velocities are measured in lengths per step, so that all entries are of one size. The push is the cube root of
    rounding times the system's size, where truncation and rounding of central differences balance.
    """
    motion = SpringMotion(system)
    free = ~system.fixed
    count = int(free.sum()) * system.dimension
    push = np.cbrt(np.finfo(float).eps) * system.size

    def step(z: Array) -> Array:
        x, v = equilibrium.positions.copy(), equilibrium.velocities.copy()
        x[free] += z[:count].reshape(-1, system.dimension)
        v[free] += z[count:].reshape(-1, system.dimension) / dt
        end = scheme.step(motion, State(0.0, x, v), dt)
        return np.concatenate([end.positions[free].ravel(), dt * end.velocities[free].ravel()])

    pushes = push * np.eye(2 * count)
    return np.stack([(step(z) - step(-z)) / (2 * push) for z in pushes], axis=1)


def growth(scheme: Scheme, system: MassSpringSystem, equilibrium: State, dt: float) -> float:
    """The spectral radius of the step: by how much the worst push grows in a step, in the long run."""
    with np.errstate(over="ignore", invalid="ignore"):
        jacobian = step_jacobian(scheme, system, equilibrium, dt)
    return float(np.abs(np.linalg.eigvals(jacobian)).max()) if np.isfinite(jacobian).all() else np.inf


def largest_stable_dt(scheme: Scheme, system: MassSpringSystem, equilibrium: State, precision: float = 1e-4) -> float:
    """The dt [s] from which on pushes grow, by bisection to a relative precision; 0 where they grow at any dt.

    Args:
        equilibrium: where all forces balance, from `exact.equilibrium`.
    """
    high = 4 / np.sqrt(_stiffest(system))
    while growth(scheme, system, equilibrium, high) <= 1 + MARGIN and high < 1e6:
        high *= 2
    low = 1e-3 * high
    if growth(scheme, system, equilibrium, low) > 1 + MARGIN:
        return 0.0
    while high / low > 1 + precision:
        middle = np.sqrt(low * high)
        stable = growth(scheme, system, equilibrium, middle) <= 1 + MARGIN
        low, high = (middle, high) if stable else (low, middle)
    return float(low)


def _stiffest(system: MassSpringSystem) -> float:
    """A bound [1/s^2] on the square of the highest frequency: no mode is stiffer than a mass on all its springs."""
    total = np.zeros(len(system.masses))
    for end in system.springs.T:
        np.add.at(total, end, system.stiffness)
    return float((2 * total / system.masses).max())
