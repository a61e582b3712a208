"""What a scheme may know of the system it advances: its equations of motion, as far as the scheme says it needs them.

The first parameter of a scheme is annotated with one of the protocols below, and the scheme is given what that has, and
nothing else (`schemes.catalogue.Scheme.on`). The less it asks for, the more equations it can step.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Protocol

from reference.state import Array, Slope, State, Trajectory
from reference.system import MassSpringSystem

if TYPE_CHECKING:
    from reference.assembly import Blocks
    from reference.distance_constraints import Rods


class Motion(Protocol):
    """Accelerations x'' = a(x, v) of all masses at once: of springs, pendulums, symbols, small perturbations."""

    def acceleration(self, state: State, /) -> Array:
        """X'' at a state, the shape of its positions."""

    def slope(self, state: State, /) -> Slope:
        """(1, x', x''): the rate of change of the whole state."""


class MotionByMass(Motion, Protocol):
    """Accelerations of one mass at a time too: what a scheme asks for that writes what it is still reading."""

    def acceleration_of(self, i: int, state: State, /) -> Array:
        """X'' of mass i alone, shape (d,)."""


class MotionOfSprings(Motion, Protocol):
    """The springs themselves and the Jacobians of their forces: for implicit and semi-implicit schemes."""

    @property
    def system(self) -> MassSpringSystem:
        """The masses and springs."""

    def acceleration(self, state: State, /, damping: bool = True) -> Array:
        """X'' at a state; without the damping of the springs where that is treated apart. Drag stays in."""

    def placed(self, state: State, /) -> State:
        """Where springs have their directions: where the masses are."""

    def jacobians(self, state: State, /) -> tuple[Blocks, Blocks]:
        """The derivatives of the forces by positions [N/m] and by velocities [N s/m], spring by spring."""


class MotionOfRods(Motion, Protocol):
    """Masses joined by distance constraints (`distance_constraints`)."""

    @property
    def rest_lengths(self) -> Array:
        """Of the rods [m], shape (r,)."""

    def rods(self, state: State, /) -> Rods:
        """Where the rods point, and the rates at which their lengths change."""

    def constrained(self, state: State, rods: Rods, target: Array, compliance: float = 0.0) -> Array:
        """X'' of all masses, with the multipliers that give the rods their target accelerations."""


class EveryMotion(MotionByMass, MotionOfSprings, MotionOfRods, Protocol):
    """All of that at once. Nothing is; but a step that asks for any of it can be called with it, says the type."""


class Equations(Motion, Protocol):
    """Equations of motion with a start, to be simulated: `forces.SpringMotion`, `pendulum`, `distance_constraints`."""

    @property
    def start(self) -> State:
        """The state at time zero."""

    def state_of(self, state: State, /) -> State:
        """The state in its own coordinates, from positions and velocities of the masses."""

    def trajectory(self, states: list[State], /) -> Trajectory:
        """The states of a run, told as positions and velocities of the masses."""


#: What makes equations of motion of a system: it says what springs are taken for.
EquationsOf = Callable[[MassSpringSystem], Equations]
