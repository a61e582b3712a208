"""Where all forces balance: in closed form for a string that hangs, else by least energy."""

from __future__ import annotations

import numpy as np

from reference.assembly import DENSE_UP_TO, assemble, spring_blocks
from reference.conserved import energy
from reference.errors import InputError, SolverError
from reference.forces import SpringMotion
from reference.spring_law import stretch_under
from reference.state import Array, State
from reference.system import MassSpringSystem
from reference.theory.least_energy import force_tolerance, least_energy


def equilibrium(system: MassSpringSystem) -> State:
    """The state at rest in which all forces balance, reached by giving way from the start.

    In closed form for a string hanging down; else least energy by L-BFGS, then Newton's method to rounding. Of large
    systems see `least_energy`.

    Raises:
        SolverError: if there is none nearby (a free system falls for ever); for a system with obstacles.
    """
    if system.obstacles:
        raise SolverError(
            "no equilibrium: with obstacles the forces need not balance, and a small perturbation may meet one"
        )
    flat = system.dimension > 1
    if flat and system.is_string and system.stiffness.all() and not system.gravity[0] and not system.gravity[2:].any():
        return hanging_string(system)
    from scipy.optimize import minimize

    free = ~system.fixed
    if free.all() and system.gravity.any():
        raise SolverError("no equilibrium: nothing holds the system, it falls for ever")
    if free.sum() * system.dimension > DENSE_UP_TO:
        return least_energy(system)
    motion = SpringMotion(system)

    def at(coordinates: Array) -> State:
        positions = system.positions.copy()
        positions[free] = coordinates.reshape(-1, system.dimension)
        return State(0.0, positions, np.zeros_like(positions))

    def force(coordinates: Array) -> Array:
        forces = motion.acceleration(at(coordinates)) * system.masses[:, None]
        return np.asarray(forces[free].ravel())

    weight = float((system.masses[:, None] * np.abs(system.gravity)).sum()) or 1.0
    found = minimize(
        lambda q: energy(system, at(q)) / (weight * system.size),
        system.positions[free].ravel(),
        jac=lambda q: -force(q) / (weight * system.size),
        method="L-BFGS-B",
        options={"maxiter": 50_000, "maxfun": 100_000, "ftol": 1e-16, "gtol": 1e-9},
    )
    q = found.x
    for _ in range(30):
        stiffness = -assemble(system, spring_blocks(system, at(q))[0], sparse=False)
        change = np.linalg.lstsq(stiffness, force(q))[0]
        q = q + change
        if np.abs(change).max() < 1e-14 * system.size:
            break
    if not np.abs(force(q)).max() < force_tolerance(system, weight):
        raise SolverError("no equilibrium: the forces do not balance anywhere near the start")
    return at(q)


def hanging_string(system: MassSpringSystem) -> State:
    """The equilibrium of a string under its own weight: straight down, each spring carrying all that is below it.

    The length of spring j is L0_j and the stretch under (m_{j+1} + ... + m_n) g, which is that over k_j.

    Raises:
        InputError: unless the system is a string in 2D, hung at its first mass, with stiffness everywhere.
    """
    n = len(system.positions)
    if not system.is_string or not system.stiffness.all() or system.dimension != 2 or system.gravity[0]:
        raise InputError(
            "system is no string: expected springs from each mass to the next, all with stiffness > 0, in 2D under "
            "gravity along the second axis"
        )
    below = np.cumsum(system.masses[:0:-1])[::-1]
    lengths = system.rest_lengths + stretch_under(system.stiffness, below * -system.gravity[1])
    positions = np.tile(system.positions[0], (n, 1))
    positions[1:, 1] -= np.cumsum(lengths)
    return State(0.0, positions, np.zeros_like(positions))
