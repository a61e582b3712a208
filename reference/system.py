"""What is simulated: masses joined by damped springs. Needs NumPy only, as engines may run in a bare environment."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass, field, fields, replace
from math import isfinite
from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt

from reference.axes import downwards, vertical_axis
from reference.checked_numbers import (
    LARGEST,
    SMALLEST,
    check_sizes,
    finite,
    in_range,
    refuse,
    refuse_below,
    refuse_twice,
    shaped,
    truths,
)
from reference.checked_springs import BoolArray as BoolArray
from reference.checked_springs import IntArray as IntArray
from reference.checked_springs import checked_springs, refuse_together
from reference.collisions.round_masses import Collisions
from reference.errors import InputError, unknown_name
from reference.obstacles import Obstacle, checked_obstacles
from reference.pulls import PULL, UNIT, is_pull, place_of_pull
from reference.springs.angular import AngularSprings
from reference.springs.kinds import KINDS, NonlinearSprings
from reference.state import Array, State

T = TypeVar("T")

#: A parameter's value: one number, or one for each mass, spring or axis.
Value = float | Sequence[float]

#: The parameters that can be set, also while the system moves (lecture slide 12), with their units.
PARAMETERS = {
    "mass": "kg, of every mass",
    "rest_length": "m, of every spring",
    "stiffness": "N/m, of every spring",
    "damping": "N s/m, of every spring, along it",
    "drag": "N s/m, on every mass",
    "gravity": "m/s^2, downwards",
}

#: What can happen to masses while the system moves, and whether they are fixed then.
HELD = {"hold": True, "release": False}

#: And to springs: from then on they are gone.
BREAK = "break"

#: What scenes have besides, and what stays as it is while the system moves.
NEVER_CHANGED = (*KINDS, "radii", "restitution", "angular_stiffness", "angular_springs", "rest_angle")

#: Those of the parameters that are fields by another name.
FIELDS = {"mass": "masses", "rest_length": "rest_lengths"}

#: The fields that have an entry for every spring.
OF_SPRINGS = ("springs", "rest_lengths", "stiffness", "damping", "broken")

#: Which parameters cannot be zero, or less.
ABOVE_ZERO = ("mass",)
NOT_BELOW_ZERO = ("rest_length", "stiffness", "damping", "drag")


@dataclass(frozen=True, eq=False)
class MassSpringSystem:
    """Masses joined by damped springs, under gravity and drag. Frozen and validated; arrays are read-only.

    Where an array of one number per mass or per spring is expected, a single number does for all of them.

    Attributes:
        positions: where every mass starts [m], shape (n, d) with d = 1, 2 or 3.
        springs: the two masses each spring joins, shape (s, 2).
        masses: [kg], shape (n,), each > 0 (a fixed mass has one too: engines want it).
        rest_lengths: [m], shape (s,), each >= 0. A spring of rest length 0 pulls with k times where its masses are
            apart, and so it has no force where they are in one place; any other has no direction there, and none starts
            so.
        stiffness: k [N/m], shape (s,), each >= 0.
        damping: c [N s/m] along each spring, shape (s,), each >= 0.
        drag: Cd [N s/m] on every mass, >= 0 (lecture slide 10).
        gravity: [m/s^2], shape (d,); a single number g means downwards, along the vertical axis (`vertical_axis`).
        velocities: [m/s], shape (n, d); zero unless given.
        fixed: which masses never move, shape (n,).
        obstacles: what free masses may not enter; they are projected out at the end of every step, in this order.
        nonlinear: what springs have besides stiffness and damping; None where all are linear.
        collisions: which masses are round and collide with one another; None where none do.
        pulls: constant forces on the masses [N], shape (n, d); zero unless given. What is fixed does not feel its own.
        angular_springs: what resists bending at a mass; None where nothing does.
        broken: which springs are gone for good, shape (s,): no parameter that is set later brings one back.

    Raises:
        InputError: naming the field, the index, the value, and what was expected.
    """

    positions: Array
    springs: IntArray
    masses: Array
    rest_lengths: Array
    stiffness: Array
    damping: Array = field(default_factory=lambda: np.zeros(1))
    drag: float = 0.0
    gravity: Array = field(default_factory=lambda: np.array(9.81))
    velocities: Array = field(default_factory=lambda: np.zeros(1))
    fixed: BoolArray = field(default_factory=lambda: np.zeros(1, dtype=bool))
    obstacles: tuple[Obstacle, ...] = ()
    nonlinear: NonlinearSprings | None = None
    collisions: Collisions | None = None
    pulls: Array = field(default_factory=lambda: np.zeros(1))
    angular_springs: AngularSprings | None = None
    broken: BoolArray = field(default_factory=lambda: np.zeros(1, dtype=bool))

    def __post_init__(self) -> None:
        positions = finite("positions", self.positions, "m")
        if positions.ndim != 2 or positions.shape[1] not in (1, 2, 3) or len(positions) == 0:
            raise InputError(f"positions has shape {positions.shape}: expected (n, 1), (n, 2) or (n, 3) with n >= 1")
        n, d = positions.shape
        springs = checked_springs(self.springs, n)
        s = len(springs)
        gravity = finite("gravity", self.gravity, "m/s^2")
        # no pull at all fits any number of masses, and none broken any of springs, so that `replace` may give it others
        pulls = finite("pulls", self.pulls, UNIT)
        pulls = pulls if pulls.any() else np.zeros(1)
        broken = truths("broken", self.broken, "spring")
        checked = {
            "positions": positions,
            "springs": springs,
            "masses": in_range("masses", self.masses, (n,), "kg", above_zero=True),
            "rest_lengths": in_range("rest_lengths", self.rest_lengths, (s,), "m"),
            "stiffness": in_range("stiffness", self.stiffness, (s,), "N/m"),
            "damping": in_range("damping", self.damping, (s,), "N s/m"),
            "gravity": shaped("gravity", downwards(gravity, d), (d,)),
            "velocities": shaped("velocities", finite("velocities", self.velocities, "m/s"), (n, d)),
            "pulls": shaped("pulls", pulls, (n, d)),
            "fixed": shaped("fixed", truths("fixed", self.fixed, "mass"), (n,)),
            "broken": shaped("broken", broken if broken.any() else np.zeros(1, dtype=bool), (s,)),
        }
        object.__setattr__(self, "drag", float(in_range("drag", self.drag, (), "N s/m")))
        for name, array in checked.items():
            array = np.ascontiguousarray(array).copy()
            array.flags.writeable = False
            object.__setattr__(self, name, array)
        refuse_together(self.springs, self.positions, self.rest_lengths)
        moving_anchor = np.flatnonzero(self.fixed & self.velocities.any(axis=1))
        if len(moving_anchor):
            i = moving_anchor[0]
            raise InputError(f"velocities[{i}] = {self.velocities[i].tolist()}: expected zero, mass {i} is fixed")
        obstacles = checked_obstacles(self.obstacles, self.positions, self.fixed, self.size)
        object.__setattr__(self, "obstacles", obstacles)
        if self.nonlinear is not None:
            object.__setattr__(self, "nonlinear", _given("nonlinear", self.nonlinear, NonlinearSprings).checked(s))
        if self.collisions is not None:
            made = _given("collisions", self.collisions, Collisions).checked(self.positions)
            object.__setattr__(self, "collisions", made)
        if self.angular_springs is not None:
            bent = _given("angular_springs", self.angular_springs, AngularSprings).checked(self.positions)
            object.__setattr__(self, "angular_springs", bent)

    @property
    def dimension(self) -> int:
        """d: 1 along a line, 2 in the plane, 3 in space."""
        return int(self.positions.shape[1])

    @property
    def vertical_axis(self) -> int:
        """The axis that points upwards: the second; along a line, the one there is."""
        return vertical_axis(self.dimension)

    @property
    def size(self) -> float:
        """A length [m] to measure errors against: the widest extent, or the longest spring's rest length."""
        extent = float(np.ptp(self.positions, axis=0).max())
        return max(extent, float(self.rest_lengths.max(initial=0.0)))

    @property
    def scale(self) -> float:
        """A length [m] that rounding is a part of, never zero: size or largest coordinate; 1 m where both are zero."""
        return max(self.size, float(np.abs(self.positions).max())) or 1.0

    @property
    def shortest(self) -> float:
        """The smallest rest length above zero [m], for perturbations to be small against; without any the scale."""
        above = self.rest_lengths[self.rest_lengths > 0]
        return float(above.min()) if len(above) else self.scale

    @property
    def is_string(self) -> bool:
        """Whether it is the lecture's string: spring j joins masses j and j + 1, and mass 0 alone is fixed."""
        n = len(self.positions)
        chain = [set(pair) for pair in self.springs.tolist()] == [{j, j + 1} for j in range(n - 1)]
        return chain and n >= 2 and bool(self.fixed[0]) and not self.fixed[1:].any()

    @property
    def off_rest_length(self) -> BoolArray:
        """Which springs start off their rest length by more than 1e-12 of it and what positions round, shape (s,)."""
        a, b = self.springs.T
        lengths = np.linalg.norm(self.positions[b] - self.positions[a], axis=1)
        rounding = 4 * np.finfo(np.float64).eps * np.abs(self.positions).max()
        return np.asarray(np.abs(lengths - self.rest_lengths) > 1e-12 * lengths + rounding)

    @property
    def slackens(self) -> BoolArray:
        """Which springs carry nothing when they are short, or long, shape (s,)."""
        law = self.nonlinear
        return np.zeros(len(self.springs), dtype=bool) if law is None else law.tension_only | law.compression_only

    @property
    def start(self) -> State:
        """The state at time zero."""
        return State(0.0, self.positions, self.velocities)

    def at(self, state: State) -> MassSpringSystem:
        """The same system, starting from a state. Raises InputError as a new system does."""
        return replace(self, positions=state.positions, velocities=state.velocities)

    def with_parameter(self, name: str, value: Value) -> MassSpringSystem:
        """The same system with one of PARAMETERS set: one number for all, or one for each mass, spring or axis.

        Or with masses held or released, or springs broken: `hold` and `release` take the number of a mass, or several,
        `break` that of springs. Or with a mass pulled along an axis: `pull.3.y` takes a force [N].

        Nothing else is looked at again: a parameter may change at every step of a run.

        Raises:
            InputError: for an unknown name, a value that makes no sense, or another number of numbers.
        """
        if name in HELD:
            return self._with_held(name, value)
        if name == BREAK:
            return self._broken(value)
        if is_pull(name):
            return self._pulled(name, value)
        if name in NEVER_CHANGED:
            changeable = ", ".join([*PARAMETERS, *HELD, BREAK])
            raise InputError(f"parameter {name!r}: it cannot change on the fly; what can: {changeable}, and pulls")
        if name not in PARAMETERS:
            raise unknown_name("parameter", name, [*PARAMETERS, *HELD, BREAK, f"{PULL}MASS.AXIS"])
        changed = copy(self)
        object.__setattr__(changed, FIELDS.get(name, name), self._checked_parameter(name, value))
        return changed

    def _with_held(self, name: str, value: Value) -> MassSpringSystem:
        masses = finite(name, value, "masses' numbers").reshape(-1)
        refuse(name, masses, ~np.isin(masses, range(len(self.masses))), f"a mass from 0 to {len(self.masses) - 1}")
        fixed = self.fixed.copy()
        fixed[masses.astype(int)] = HELD[name]
        fixed.flags.writeable = False
        changed = copy(self)
        object.__setattr__(changed, "fixed", fixed)
        return changed

    def _pulled(self, name: str, value: Value) -> MassSpringSystem:
        place, force = place_of_pull(name, self.pulls), finite(name, value, UNIT)
        if force.size != 1:
            raise InputError(f"{name} has {force.size} numbers: expected one [{UNIT}]")
        pulls, changed = self.pulls.copy(), copy(self)
        pulls[place] = force.item()
        pulls.flags.writeable = False
        object.__setattr__(changed, "pulls", pulls)
        return changed

    def numbers_of(self, parameter: str) -> Array:
        """A parameter's numbers as they are, of every spring, mass or axis, or the one there is: shape (k,)."""
        if is_pull(parameter):
            return np.array([self.pulls[place_of_pull(parameter, self.pulls)]])
        return np.atleast_1d(np.asarray(getattr(self, FIELDS.get(parameter, parameter)), dtype=np.float64))

    def _broken(self, value: Value) -> MassSpringSystem:
        """Springs that break have neither stiffness nor damping from then on, and are linear; their bends go, too."""
        broken = finite(BREAK, value, "springs' numbers").reshape(-1)
        refuse_twice(BREAK, broken.tolist())
        refuse(BREAK, broken, ~np.isin(broken, range(len(self.springs))), f"a spring from 0 to {len(self.springs) - 1}")
        which, changed = broken.astype(int), copy(self)
        for name in ("stiffness", "damping"):
            array = getattr(self, name).copy()
            array[which] = 0.0
            array.flags.writeable = False
            object.__setattr__(changed, name, array)
        gone = self.broken.copy()
        gone[which] = True
        gone.flags.writeable = False
        object.__setattr__(changed, "broken", gone)
        if self.nonlinear is not None:
            object.__setattr__(changed, "nonlinear", self.nonlinear.without(which))
        if self.angular_springs is not None:
            left = self.angular_springs.without_broken_arms(self.springs, gone)
            object.__setattr__(changed, "angular_springs", left)
        return changed

    def _checked_parameter(self, name: str, value: Value) -> Array | float:
        unit = PARAMETERS[name].partition(",")[0]
        array = finite(name, value, unit)
        if name != "gravity":
            refuse_below(name, array, unit, above_zero=name in ABOVE_ZERO)
        if name == "drag":
            if array.size != 1:
                raise InputError(f"drag has {array.size} numbers: expected one [{unit}]")
            return float(array.item())
        count, what = {"mass": (len(self.masses), "masses"), "gravity": (self.dimension, "axes")}.get(
            name, (len(self.springs), "springs")
        )
        if array.size != 1 and array.shape != (count,):
            raise InputError(f"{name} has {array.size} numbers: expected one, or one for each of {count} {what}")
        spread = downwards(array, count) if name == "gravity" else array.reshape(-1)
        whole = np.array(np.broadcast_to(spread, (count,)))
        if name in ("stiffness", "damping"):
            whole[self.broken] = 0.0
        whole.flags.writeable = False
        return whole

    def check_sizes(self) -> None:
        """Refuse numbers of which products would be no floats, as nothing has them. Raises InputError."""
        sizes = (
            "positions",
            "velocities",
            "masses",
            "rest_lengths",
            "stiffness",
            "damping",
            "drag",
            "gravity",
            "pulls",
        )
        for name in sizes:
            check_sizes(name, getattr(self, name), divided_by=name == "masses")

    def renumbered(self, order: npt.ArrayLike) -> MassSpringSystem:
        """The same system with its masses listed in another order: mass order[i] becomes mass i."""
        old = np.asarray(order, dtype=np.int64)
        new_of_old = np.empty_like(old)
        new_of_old[old] = np.arange(len(old))
        return replace(
            self,
            positions=self.positions[old],
            velocities=self.velocities[old],
            masses=self.masses[old],
            fixed=self.fixed[old],
            pulls=self.pulls[old],
            springs=new_of_old[self.springs],
            collisions=self.collisions and self.collisions.renumbered(old),
            angular_springs=self.angular_springs and self.angular_springs.renumbered(new_of_old),
        )

    def with_springs_reversed(self) -> MassSpringSystem:
        """The same system with its springs listed from the last to the first."""
        backwards = {name: getattr(self, name)[::-1] for name in OF_SPRINGS}
        law = self.nonlinear
        return replace(self, **backwards, nonlinear=law and law.of(slice(None, None, -1)))

    def with_ends_swapped(self) -> MassSpringSystem:
        """The same system with each spring named from its other end."""
        return replace(self, springs=self.springs[:, ::-1])

    def of_spring(self, j: int) -> MassSpringSystem:
        """The same masses with one of the springs, as it is."""
        one = {name: getattr(self, name)[j : j + 1] for name in OF_SPRINGS}
        return replace(self, **one, nonlinear=self.nonlinear and self.nonlinear.of(slice(j, j + 1)))

    def to_dict(self) -> dict[str, Any]:
        """Plain lists and numbers, the fields by name: what a digest or a JSON file is made of."""
        values = {f.name: getattr(self, f.name) for f in fields(self)}
        values["obstacles"] = [obstacle.to_dict() for obstacle in self.obstacles]
        for name in ("nonlinear", "collisions", "angular_springs"):
            given = values.pop(name)
            values |= {name: given.to_dict()} if given else {}
        for name in ("pulls", "broken"):
            if not values[name].any():
                del values[name]
        return {name: v.tolist() if isinstance(v, np.ndarray) else v for name, v in values.items()}


def check_parameter(name: str, value: float) -> None:
    """Refuse a number that one of PARAMETERS cannot be, by the parameter's name. Other names take any finite number.

    Raises:
        InputError: with the name, the value and what was expected.
    """
    unit = f" [{PARAMETERS[name].partition(',')[0]}]" if name in PARAMETERS else ""
    if not isfinite(value):
        raise InputError(f"{name} = {value:g}: expected a finite number{unit}")
    if abs(value) > LARGEST:
        raise InputError(f"{name} = {value:g}: expected a number of at most {LARGEST:g}{unit}")
    if (name in ABOVE_ZERO and value <= 0) or (name in NOT_BELOW_ZERO and value < 0):
        raise InputError(f"{name} = {value:g}: expected a number {'>' if name in ABOVE_ZERO else '>='} 0{unit}")
    if name in ABOVE_ZERO and value < SMALLEST:
        raise InputError(f"{name} = {value:g}: expected a number of at least {SMALLEST:g}{unit}")


def _given(name: str, value: Any, expected: type[T]) -> T:
    if not isinstance(value, expected):
        raise InputError(f"{name} = {value!r}: expected {expected.__name__}, or None")
    return value
