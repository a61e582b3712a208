"""A system at rest, by whichever equations of motion it has: springs, a pendulum, or masses on rods."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from reference.distance_constraints import RopeMotion
from reference.errors import SolverError
from reference.forces import SpringMotion
from reference.motion import Equations, EquationsOf
from reference.pendulum import PendulumMotion
from reference.springs.breaking import breaking, tensions
from reference.springs.nonlinear_law import tangent_system
from reference.state import State
from reference.system import BoolArray, MassSpringSystem
from reference.theory.contacts import ContactLinearisation, Contacts
from reference.theory.equilibrium import equilibrium
from reference.theory.linear_motion import LinearMotion, LinearPendulum
from reference.theory.linearisation import Linearisation
from reference.theory.rest_on_obstacles import rest_on_obstacles


@dataclass(frozen=True)
class Equilibrium:
    """A system at rest, ready to be perturbed.

    Attributes:
        motion: its equations.
        state: at rest, all forces in balance.
        free: which rows of the state can move.
        scale: a length [m] (for a pendulum an angle [rad]) that perturbations are to be small against.
        contacts: what rests on obstacles; None where nothing does.
        by_law: the equations of motion with the springs' own law, where `motion` has their tangents at the rest: a step
            on obstacles stays beside the rest, and sees them there.
    """

    motion: Equations
    state: State
    free: BoolArray
    scale: float
    contacts: Contacts | None = None
    by_law: Equations | None = None

    @property
    def stepped(self) -> Equations:
        """What a scheme steps on obstacles."""
        return self.motion if self.by_law is None else self.by_law

    @property
    def system(self) -> MassSpringSystem:
        """Of masses and springs. Raises TypeError for other equations."""
        if not isinstance(self.motion, SpringMotion):
            raise TypeError(f"{type(self.motion).__name__} has no masses and springs")
        return self.motion.system

    @cached_property
    def linear(self) -> Linearisation | None:
        """The equations of motion of springs, linearised here; None of other equations."""
        if not isinstance(self.motion, SpringMotion):
            return None
        if self.contacts is None:
            return Linearisation(self.motion.system, self.state)
        return ContactLinearisation(self.motion.system, self.state, contacts=self.contacts)

    @cached_property
    def linear_motion(self) -> LinearMotion | LinearPendulum | None:
        """The same for schemes to step, of springs that rest on nothing, or of a pendulum; None of others."""
        if isinstance(self.motion, PendulumMotion):
            return LinearPendulum(self.motion, self.state)
        return None if self.linear is None or self.contacts is not None else self.linear.motion


def spring_equilibrium(system: MassSpringSystem) -> Equilibrium:
    """Where a mesh of springs comes to rest, on obstacles if it has any. Raises SolverError if it never does.

    Of springs that are not linear it has the linear ones that do the same there (`nonlinear_law.tangent_system`).
    """
    contacts = None
    if system.obstacles:
        state, touching = rest_on_obstacles(system)
        contacts = touching if len(touching) else None
    else:
        state = equilibrium(system)
    _refuse_overlap(system, state)
    _refuse_breaking(system, state)
    scale = min(system.shortest, system.size or 1.0)
    tangent = SpringMotion(tangent_system(system, state))
    by_law = None if system.nonlinear is None else SpringMotion(system)
    return Equilibrium(tangent, state, ~system.fixed, scale, contacts, by_law)


def _refuse_overlap(system: MassSpringSystem, state: State) -> None:
    """Masses that collide must be apart at rest: how they would rest on one another is not computed."""
    if system.collisions is None:
        return
    touching = system.collisions.pairs(state.positions).tolist()
    if touching:
        i, j = touching[0]
        raise SolverError(
            f"no equilibrium: masses {i} and {j} would be in one another, and rest on one another instead"
        )


def _refuse_breaking(system: MassSpringSystem, state: State) -> None:
    """Springs must hold at rest: of one that breaks there, there is no such rest."""
    broken = breaking(system, state).tolist()
    if broken:
        j = broken[0]
        force = float(tensions(system, state.positions, state.velocities)[j])
        raise SolverError(f"no equilibrium: spring {j} would carry {force:.4g} N at rest, and breaks there")


def equilibrium_on_obstacles(system: MassSpringSystem) -> tuple[Equilibrium, str]:
    """Where a system with obstacles comes to rest, on them if that is found, else without them; and which, in words."""
    try:
        rest = spring_equilibrium(system)
    except SolverError as error:
        alone = spring_equilibrium(replace(system, obstacles=()))
        return alone, f"of the scene without its obstacles: {error}"
    if rest.contacts is None:
        return rest, "at its rest no mass presses on an obstacle"
    pressed = len(set(rest.contacts.masses.tolist()))
    return rest, f"about its rest on obstacles, where {pressed} mass{'es press' if pressed > 1 else ' presses'}"


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
