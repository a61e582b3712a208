"""What masses may not enter: circle, sphere, cylinder, plane, box, as on slides 16-17. Needs NumPy only.

All are hard and without friction, and do not move. The rule: a mass that is inside moves straight out to the surface
and loses the part of its velocity that leads inwards, no more: an obstacle pushes and never pulls. (Slide 17 takes what
leads outwards too, and prints another rule again: `slide_17`. `springlab run barrier` shows what comes of each.)

There is one definition of each kind: `surface`, written for numbers, one per axis. NumPy runs it on arrays of them, and
`tracing` on symbols, to make of it a part of the loops that advance large systems.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields
from functools import reduce
from types import MappingProxyType
from typing import Any

import numpy as np
import numpy.typing as npt

from reference.axes import Axes, across, axes_of, direction, dot, less, vectors_of
from reference.errors import InputError, unknown_name
from reference.state import Array

#: A mass may start inside by this part of the system's size: a state that was pushed out and rounded is a start too.
ROUNDING = 1e-9


@dataclass(frozen=True)
class Obstacle:
    """What all kinds have in common. Their fields are numbers, or tuples of numbers."""

    @property
    def kind(self) -> str:
        """What it is called in scene files, and as a capability of engines."""
        return type(self).__name__.lower()

    @property
    def dimension(self) -> int:
        """Of the space it stands in, 2 or 3."""
        raise NotImplementedError

    def surface(self, place: Axes) -> tuple[Any, Axes]:
        """How far a place [m] is from the surface [m], negative inside; the unit normal outwards there.

        All that distinguishes one kind from another. It works on numbers, arrays and symbols alike: of Python it may
        use + - * / < > and &, of NumPy what `tracing.OPERATIONS` has. For a choice that is `np.where`, never `if`.
        Where there is no way straight out (at a centre), a normal is chosen.
        """
        raise NotImplementedError

    def answer(self, velocity: Axes, normal: Axes) -> Axes:
        """The velocity [m/s] of a mass inside after it has met the obstacle: v - min(v.n, 0) n. No mass gains speed."""
        inwards = dot(velocity, normal)
        inwards = np.where(inwards < 0, inwards, 0.0)
        return [v - inwards * n for v, n in zip(velocity, normal, strict=True)]

    def meet(self, place: Axes, velocity: Axes, free: Any) -> tuple[Axes, Axes]:
        """The rule: with g < 0 the gap and n the normal, x becomes x - g n, and v what the obstacle answers.

        Args:
            place: [m]. velocity: [m/s]. free: whether the mass can move.
        """
        gap, normal = self.surface(place)
        inside = free & (gap < 0)
        pushed = [np.where(inside, x - gap * n, x) for x, n in zip(place, normal, strict=True)]
        kept = zip(self.answer(velocity, normal), velocity, strict=True)
        return pushed, [np.where(inside, after, before) for after, before in kept]

    def gap(self, positions: Array) -> tuple[Array, Array]:
        """How far positions (..., d) are from the surface [m], (..., 1), and the normals outwards there, (..., d)."""
        gap, normal = self.surface(axes_of(positions))
        return np.asarray(gap)[..., None], vectors_of(normal, positions)

    def push_out(self, positions: Array, velocities: Array) -> tuple[Array, Array]:
        """The rule for free masses, positions [m] and velocities [m/s] of the shape (..., d)."""
        pushed, kept = self.meet(axes_of(positions), axes_of(velocities), True)
        return vectors_of(pushed, positions), vectors_of(kept, velocities)

    def to_dict(self) -> dict[str, Any]:
        """Its kind and its numbers by name, as `obstacle` takes them."""
        values = {f.name: getattr(self, f.name) for f in fields(self)}
        return {"kind": self.kind, **{name: list(v) if isinstance(v, tuple) else v for name, v in values.items()}}


@dataclass(frozen=True)
class _Ball(Obstacle):
    centre: tuple[float, ...]
    radius: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "centre", _vector("centre", self.centre, (self.dimension,)))
        object.__setattr__(self, "radius", _radius(self.radius))

    def surface(self, place: Axes) -> tuple[Any, Axes]:
        up = [0.0, 1.0, 0.0][: self.dimension]
        distance, normal = direction(less(place, self.centre), up)
        return distance - self.radius, normal


@dataclass(frozen=True)
class Circle(_Ball):
    """A circle in the plane. centre (2,) [m], radius [m]."""

    @property
    def dimension(self) -> int:
        """2."""
        return 2


@dataclass(frozen=True)
class Sphere(_Ball):
    """A sphere. centre (3,) [m], radius [m]."""

    @property
    def dimension(self) -> int:
        """3."""
        return 3


@dataclass(frozen=True)
class Cylinder(Obstacle):
    """A round bar without ends. centre (3,) [m], any point of its axis; axis (3,), its direction; radius [m]."""

    centre: tuple[float, ...]
    axis: tuple[float, ...]
    radius: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "centre", _vector("centre", self.centre, (3,)))
        object.__setattr__(self, "axis", _direction("axis", self.axis, (3,)))
        object.__setattr__(self, "radius", _radius(self.radius))

    @property
    def dimension(self) -> int:
        """3."""
        return 3

    def surface(self, place: Axes) -> tuple[Any, Axes]:
        """See Obstacle."""
        away = less(place, self.centre)
        along = dot(away, self.axis)
        away = [x - along * a for x, a in zip(away, self.axis, strict=True)]
        distance, normal = direction(away, across(self.axis))
        return distance - self.radius, normal


@dataclass(frozen=True)
class Plane(Obstacle):
    """A floor: all that is below it is inside. point (d,) [m], any of its points; normal (d,), upwards out of it."""

    point: tuple[float, ...]
    normal: tuple[float, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "point", _vector("point", self.point, (2, 3)))
        object.__setattr__(self, "normal", _direction("normal", self.normal, (self.dimension,)))

    @property
    def dimension(self) -> int:
        """2 or 3, as its point has it."""
        return len(self.point)

    def surface(self, place: Axes) -> tuple[Any, Axes]:
        """See Obstacle."""
        return dot(less(place, self.point), self.normal), self.normal


@dataclass(frozen=True)
class Box(Obstacle):
    """A rectangle or a box along the axes. centre (d,) [m]; half_sizes (d,) [m], from the centre to its faces."""

    centre: tuple[float, ...]
    half_sizes: tuple[float, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "centre", _vector("centre", self.centre, (2, 3)))
        object.__setattr__(self, "half_sizes", _vector("half_sizes", self.half_sizes, (self.dimension,)))
        if min(self.half_sizes) <= 0:
            raise InputError(f"half_sizes = {self.half_sizes!r}: expected numbers > 0 [m]")

    @property
    def dimension(self) -> int:
        """2 or 3, as its centre has it."""
        return len(self.centre)

    def surface(self, place: Axes) -> tuple[Any, Axes]:
        """See Obstacle: to the nearest face from inside, to the nearest point, which may be a corner, from outside."""
        away = less(place, self.centre)
        beyond = [np.abs(a) - half for a, half in zip(away, self.half_sizes, strict=True)]
        least_deep = reduce(np.maximum, beyond)
        distance, normal = direction([np.maximum(b, 0.0) for b in beyond], _first(beyond, least_deep))
        sides = [np.where(a < 0, -1.0, 1.0) for a in away]
        return np.where(distance > 0, distance, least_deep), [s * n for s, n in zip(sides, normal, strict=True)]


#: The kinds of obstacle by name.
KINDS: Mapping[str, type[Obstacle]] = MappingProxyType(
    {made.__name__.lower(): made for made in (Circle, Sphere, Cylinder, Plane, Box)}
)


def obstacle(kind: str, **values: Any) -> Obstacle:
    """The obstacle of a kind with its numbers by name, as scene files and `to_dict` have them.

    Raises:
        InputError: for an unknown kind, an unknown or missing number, or one that makes no sense.
    """
    if not isinstance(kind, str):
        raise InputError(f"kind = {kind!r}: expected one of {', '.join(KINDS)}")
    if kind not in KINDS:
        raise unknown_name("kind", kind, KINDS)
    names = [f.name for f in fields(KINDS[kind])]
    for name in values:
        if name not in names:
            raise unknown_name(f"number of a {kind}", name, names)
    missing = [name for name in names if name not in values]
    if missing:
        raise InputError(f"{missing[0]} is missing: a {kind} has {', '.join(names)}")
    return KINDS[kind](**values)


def keep_out(
    obstacles: Iterable[Obstacle], fixed: npt.NDArray[np.bool_], positions: Array, velocities: Array
) -> tuple[Array, Array]:
    """The end of every step: the free masses pushed out of each obstacle in turn, in the order they are listed.

    In a corner of two obstacles the last one has its way, and the next step goes on from there.

    Args:
        fixed: which masses never move, a shape that goes with (..., d). Those may stand inside.
        positions: shape (..., d) [m]. velocities: the same shape [m/s]. Neither is written to.
    """
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):  # of what has blown up
        place, velocity, free = axes_of(positions), axes_of(velocities), ~fixed[..., 0]
        for barrier in obstacles:
            place, velocity = barrier.meet(place, velocity, free)
    return vectors_of(place, positions), vectors_of(velocity, velocities)


def checked(
    obstacles: Iterable[Any], positions: Array, fixed: npt.NDArray[np.bool_], size: float
) -> tuple[Obstacle, ...]:
    """The obstacles of a system, given as such or as `to_dict` has them.

    Raises:
        InputError: for one of another dimension, and for a free mass inside one by more than ROUNDING of the size [m].
    """
    if not isinstance(obstacles, list | tuple):
        raise InputError(f"obstacles = {obstacles!r}: expected a list of obstacles")
    found = []
    for i, given in enumerate(obstacles):
        made = obstacle(**given) if isinstance(given, Mapping) else given
        if not isinstance(made, Obstacle):
            raise InputError(f"obstacles[{i}] = {given!r}: expected one of {', '.join(KINDS)}")
        d = positions.shape[1]
        if made.dimension != d:
            raise InputError(f"obstacles[{i}] is a {made.kind} in {made.dimension}D: expected one in {d}D")
        with np.errstate(over="ignore", invalid="ignore"):
            gap, _ = made.gap(positions)
        inside = np.flatnonzero((gap[:, 0] < -ROUNDING * size) & ~fixed)
        if len(inside):
            j = inside[0]
            raise InputError(
                f"positions[{j}] = {positions[j].tolist()}: expected a start outside the {made.kind} obstacles[{i}], "
                f"it is {-gap[j, 0]:.3g} m inside"
            )
        found.append(made)
    return tuple(found)


def _first(values: Axes, largest: Any) -> Axes:
    """The unit vector of the first axis that has the largest value."""
    chosen: list[Any] = []
    left: Any = 1.0
    for value in values:
        chosen.append(np.where(value < largest, 0.0, left))
        left = left - chosen[-1]
    return chosen


def _vector(name: str, value: Any, dimensions: tuple[int, ...]) -> tuple[float, ...]:
    numbers = list(value) if isinstance(value, list | tuple | np.ndarray) else []
    if len(numbers) not in dimensions or not all(map(_is_number, numbers)):
        raise InputError(f"{name} = {value!r}: expected {' or '.join(map(str, dimensions))} finite numbers [m]")
    return tuple(map(float, numbers))


def _direction(name: str, value: Any, dimensions: tuple[int, ...]) -> tuple[float, ...]:
    """As a unit vector; one that is, to rounding, is left as it is."""
    vector = np.array(_vector(name, value, dimensions))
    largest = float(np.abs(vector).max())
    if largest == 0:
        raise InputError(f"{name} = {value!r}: expected a direction, not zero")
    direction = vector / largest
    length = float(np.linalg.norm(direction))
    return tuple((vector if abs(length * largest - 1) < 1e-15 else direction / length).tolist())


def _radius(value: Any) -> float:
    if not (_is_number(value) and value > 0):
        raise InputError(f"radius = {value!r}: expected a finite number > 0 [m]")
    return float(value)


def _is_number(value: Any) -> bool:
    """Whether it is a finite one: no truth, and no whole number beyond all others."""
    if isinstance(value, bool | np.bool_) or not isinstance(value, int | float | np.integer | np.floating):
        return False
    number: float = value.item() if isinstance(value, np.generic) else value
    return -sys.float_info.max <= number <= sys.float_info.max
