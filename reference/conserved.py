"""What physics keeps: energy, momentum, angular momentum. Integrators are known by how they lose them."""

from __future__ import annotations

import numpy as np

from reference.springs.angular_law import energy_of_bends
from reference.springs.nonlinear_law import energy_of_springs
from reference.state import Array, State, Trajectory
from reference.system import MassSpringSystem


def energy(system: MassSpringSystem, state: State, begin: Array | None = None) -> float:
    """Kinetic, elastic and gravitational energy together [J]: sum m v^2/2 + that of springs and bends - sum m g.x.

    A pull F on a mass counts as its weight does: -F.x, among the gravitational.

    Args:
        begin: places (n, d) [m] that x counts from, in place of the origin: where weights change on the way, energy
            from the origin jumps by as much as that is far away.
    """
    total = energy_parts(system, state)["total"]
    if begin is None:
        return total
    return total + float(system.masses @ (begin @ system.gravity) + (system.pulls * begin).sum())


def energy_parts(system: MassSpringSystem, state: State) -> dict[str, float]:
    """The same, part by part [J]: kinetic, elastic, gravitational (zero at height zero) and total."""
    a, b = system.springs.T
    stretch = np.linalg.norm(state.positions[b] - state.positions[a], axis=1) - system.rest_lengths
    kinetic = 0.5 * system.masses @ (state.velocities**2).sum(axis=1)
    elastic = energy_of_springs(system, stretch).sum() + _bent(system, state.positions)
    weight = system.masses @ (state.positions @ system.gravity) + (system.pulls * state.positions).sum()
    return {
        "kinetic": float(kinetic),
        "elastic": float(elastic),
        "gravitational": -float(weight),
        "total": float(kinetic + elastic - weight),
    }


def energies(system: MassSpringSystem, trajectory: Trajectory) -> Array:
    """The same at each time of a trajectory [J], shape (m,)."""
    a, b = system.springs.T
    x = trajectory.positions
    stretch = np.linalg.norm(x[:, b] - x[:, a], axis=2) - system.rest_lengths
    kinetic = 0.5 * (trajectory.velocities**2).sum(axis=2) @ system.masses
    elastic = energy_of_springs(system, stretch).sum(axis=1) + _bent(system, x)
    weight = (x @ system.gravity) @ system.masses + (x * system.pulls).sum(axis=(1, 2))
    return np.asarray(kinetic + elastic - weight)


def _bent(system: MassSpringSystem, positions: Array) -> Array | float:
    """Of all angular springs [J], with masses at positions (..., n, d): shape (...)."""
    angular = system.angular_springs
    return 0.0 if angular is None else np.asarray(energy_of_bends(angular, positions).sum(axis=-1))


def momentum(system: MassSpringSystem, state: State) -> Array:
    """Linear momentum, sum m v [kg m/s], shape (d,)."""
    return np.asarray(system.masses @ state.velocities)


def angular_momentum(system: MassSpringSystem, state: State) -> Array:
    """Angular momentum about the origin, sum m x cross v [kg m^2/s]: shape (3,), in 2D along the third axis."""
    x, v = (np.pad(a, ((0, 0), (0, 3 - system.dimension))) for a in (state.positions, state.velocities))
    return np.asarray((system.masses[:, None] * np.cross(x, v)).sum(axis=0))
