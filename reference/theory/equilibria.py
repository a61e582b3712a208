"""A system at rest, by whichever equations of motion it has: springs, a pendulum, or masses on rods."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from reference.distance_constraints import RopeMotion
from reference.forces import SpringMotion
from reference.motion import Equations, EquationsOf
from reference.pendulum import PendulumMotion
from reference.state import State
from reference.system import BoolArray, MassSpringSystem
from reference.theory.equilibrium import equilibrium
from reference.theory.linearisation import Linearisation


@dataclass(frozen=True)
class Equilibrium:
    """A system at rest, ready to be perturbed.

    Attributes:
        motion: its equations.
        state: at rest, all forces in balance.
        free: which rows of the state can move.
        scale: a length [m] (for a pendulum an angle [rad]) that perturbations are to be small against.
    """

    motion: Equations
    state: State
    free: BoolArray
    scale: float

    @cached_property
    def linear(self) -> Linearisation | None:
        """The equations of motion of springs, linearised here; None of other equations."""
        return Linearisation(self.motion.system, self.state) if isinstance(self.motion, SpringMotion) else None


def spring_equilibrium(system: MassSpringSystem) -> Equilibrium:
    """Where a mesh of springs comes to rest. Raises SolverError if it never does."""
    free = ~system.fixed
    return Equilibrium(
        SpringMotion(system), equilibrium(system), free, float(system.rest_lengths.min(initial=system.size or 1.0))
    )


def pendulum_equilibrium(system: MassSpringSystem) -> Equilibrium:
    """All rods along gravity."""
    motion = PendulumMotion(system)
    angles = np.full(len(system.springs), np.arctan2(system.gravity[0], -system.gravity[1]))
    return Equilibrium(motion, State(0.0, angles, np.zeros_like(angles)), np.ones(len(angles), dtype=bool), 1.0)


def rope_equilibrium(system: MassSpringSystem) -> Equilibrium:
    """The same, in the masses' own coordinates."""
    hanging = pendulum_equilibrium(system)
    (positions,) = hanging.motion.trajectory([hanging.state]).positions
    state = State(0.0, positions, np.zeros_like(positions))
    return Equilibrium(RopeMotion(system), state, ~system.fixed, float(system.rest_lengths.min()))


def equilibrium_of(equations: EquationsOf, system: MassSpringSystem) -> Equilibrium:
    """Where a system comes to rest by its equations of motion."""
    known: Mapping[object, Callable[[MassSpringSystem], Equilibrium]] = {
        PendulumMotion: pendulum_equilibrium,
        RopeMotion: rope_equilibrium,
    }
    return known.get(equations, spring_equilibrium)(system)
