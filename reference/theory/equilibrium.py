"""Where all forces balance and every push comes back: in closed form for a string that hangs, else by least energy."""

from __future__ import annotations

import numpy as np

from reference.errors import InputError, SolverError
from reference.springs.linear_law import stretch_under
from reference.state import State
from reference.system import MassSpringSystem
from reference.theory.least_energy import least_energy


def equilibrium(system: MassSpringSystem) -> State:
    """The stable state at rest in which all forces balance, reached by giving way from the start.

    In closed form for a string that gravity pulls straight; else by `least_energy`, which has memory as the springs.
    What nothing holds is at rest in the frame that falls with it.

    Raises:
        SolverError: if there is none nearby, or for a system with obstacles.
    """
    if system.obstacles:
        raise SolverError(
            "no equilibrium: with obstacles the forces need not balance, and a small perturbation may meet one"
        )
    # along a line a string may stand, too: there is no side to fall to
    hangs = system.is_string and system.dimension > 1 and system.stiffness.all() and system.gravity.any()
    other = system.nonlinear is not None or system.angular_springs is not None or system.pulls.any()
    return hanging_string(system) if hangs and not other else least_energy(system)


def hanging_string(system: MassSpringSystem) -> State:
    """The equilibrium of a string under its own weight: straight, each spring carrying all that is below it.

    It hangs along gravity, whichever way that points; without any, downwards. The length of spring j is L0_j and the
    stretch under (m_{j+1} + ... + m_n) |g|, which is that over k_j.

    Raises:
        InputError: unless the system is a string with stiffness everywhere.
    """
    linear = system.nonlinear is None and system.angular_springs is None
    if not system.is_string or not system.stiffness.all() or not linear or system.pulls.any():
        raise InputError(
            "system is no string: expected springs from each mass to the next, the first fixed, all with stiffness > 0 "
            "and linear, and no mass pulled"
        )
    g = float(np.linalg.norm(system.gravity))
    downwards = -np.eye(system.dimension)[min(1, system.dimension - 1)]
    below = np.cumsum(system.masses[:0:-1])[::-1]
    lengths = system.rest_lengths + stretch_under(system.stiffness, below * g)
    positions = np.tile(system.positions[0], (len(system.positions), 1))
    positions[1:] += np.cumsum(lengths)[:, None] * (system.gravity / g if g else downwards)
    return State(0.0, positions, np.zeros_like(positions))
