"""The one idea: anything that advances a mass-spring state by dt is a stepper, and all go through the same door."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

from reference.changes import Change
from reference.distance_constraints import RopeMotion
from reference.errors import InputError, SolverError, Unsupported
from reference.forces import SpringMotion
from reference.motion import EquationsOf
from reference.outcome import Outcome, outcome_of
from reference.pendulum import PendulumMotion, why_no_pendulum
from reference.schemes import catalogue
from reference.schemes.catalogue import Scheme
from reference.schemes.constrained import ROPE_KICK_DRIFT
from reference.simulate import simulate
from reference.state import Trajectory
from reference.system import MassSpringSystem

#: What a system is taken for: springs, the angles of the rods they become, and the masses on those rods.
EQUATIONS: tuple[EquationsOf, ...] = (SpringMotion, PendulumMotion, RopeMotion)


#: What stands before a scheme's name where it steps the angles of rods.
ON_PENDULUM = "pendulum_"


class Stepper(Protocol):
    """A scheme, an engine, a lecture listing, a student's file."""

    @property
    def name(self) -> str:
        """As the command line knows it."""

    @property
    def kind(self) -> str:
        """What it is: scheme, engine_scheme, in_place, pendulum, lecture, engine."""

    @property
    def version(self) -> str | None:
        """Of the package it comes from, where it comes from one."""

    def run(self, system: MassSpringSystem, dt: float, steps: int, changes: Sequence[Change] = ()) -> Outcome:
        """Advance the system `steps` times by dt [s]. Never raises for what happens on the way: that is the outcome."""


@dataclass(frozen=True)
class SchemeStepper:
    """A catalogued scheme on the equations of motion of springs, or of the rods that very stiff springs become."""

    scheme: Scheme
    equations: EquationsOf = SpringMotion
    version: str | None = None

    @property
    def name(self) -> str:
        """The scheme's name, with `pendulum_` before it where it steps the angles of rods."""
        return f"{ON_PENDULUM}{self.scheme.name}" if self.equations is PendulumMotion else self.scheme.name

    @property
    def kind(self) -> str:
        """The scheme's kind, or pendulum."""
        return "pendulum" if self.on_rods else self.scheme.kind

    @property
    def claims(self) -> tuple[str, ...]:
        """Itself, where identification tries it only if it is named: a solver of constraints, or with parameters."""
        return (self.name,) if self.kind == "constraint_scheme" or "(" in self.name else ()

    @property
    def interactive_up_to(self) -> int | None:
        """The scheme's."""
        return self.scheme.interactive_up_to

    @property
    def on_rods(self) -> bool:
        """Whether there are rods in place of springs."""
        return self.equations is not SpringMotion

    def run(self, system: MassSpringSystem, dt: float, steps: int, changes: Sequence[Change] = ()) -> Outcome:
        """See Stepper."""
        left = self._left(system, dt, steps, changes)
        return left if isinstance(left, Outcome) else outcome_of(system, left, changes)

    def trajectory(
        self, system: MassSpringSystem, dt: float, steps: int, changes: Sequence[Change] = ()
    ) -> Trajectory | None:
        """The trajectory that a run leaves, if any: for those who do not ask whether it has blown up on the way."""
        left = self._left(system, dt, steps, changes)
        return left.trajectory if isinstance(left, Outcome) else left

    def _left(self, system: MassSpringSystem, dt: float, steps: int, changes: Sequence[Change]) -> Trajectory | Outcome:
        """What a run leaves: its trajectory, or why there is none."""
        reason = why_no_pendulum(system) if self.equations is PendulumMotion else None
        if reason:
            return Outcome("unsupported", reason)
        try:
            return simulate(system, self.scheme, dt, dt * steps, changes, self.equations)
        except SolverError as error:
            return Outcome("diverged", str(error))
        except (InputError, Unsupported) as error:
            # Only a change on the fly can still be wrong here: a rod's length cannot change while it swings.
            return Outcome("unsupported", str(error))


def catalogued() -> Mapping[str, SchemeStepper]:
    """Every scheme on springs, then those that can on the pendulum, then the rope's own, by name."""
    schemes = catalogue.schemes().values()
    on_springs = [SchemeStepper(s) for s in schemes]
    on_rods = [SchemeStepper(s, PendulumMotion) for s in schemes if s.needs == "accelerations"]
    return {stepper.name: stepper for stepper in [*on_springs, *on_rods, SchemeStepper(ROPE_KICK_DRIFT, RopeMotion)]}


def wide_catalogue() -> Mapping[str, SchemeStepper]:
    """The schemes of the wide catalogue on springs, by name."""
    return {name: SchemeStepper(scheme) for name, scheme in catalogue.wide_schemes().items()}


def stepper_named(name: str) -> SchemeStepper:
    """The catalogued stepper of a name, which may be an alias or have parameters: xpbd_jacobi(iterations=3).

    Raises:
        InputError: with a suggestion, where there is none; for a parameter that its scheme does not have.
    """
    if name == ROPE_KICK_DRIFT.name:
        return SchemeStepper(ROPE_KICK_DRIFT, RopeMotion)
    if name.startswith(ON_PENDULUM) and name not in catalogue.schemes():
        scheme = catalogue.find(name.removeprefix(ON_PENDULUM))
        if scheme.needs != "accelerations":
            raise InputError(
                f"stepper {name!r}: expected a scheme of accelerations, {scheme.name} needs {scheme.needs}"
            )
        return SchemeStepper(scheme, PendulumMotion)
    return SchemeStepper(catalogue.find(name))
