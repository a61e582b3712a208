"""The kinds of obstacle, each with its numbers and its signed distance."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from dataclasses import dataclass, fields
from functools import reduce
from types import MappingProxyType
from typing import Any

import numpy as np

from reference.axes import Axes, across, direction, dot, less
from reference.errors import InputError, unknown_name
from reference.obstacles.obstacle import Obstacle


@dataclass(frozen=True)
class _Ball(Obstacle):
    centre: tuple[float, ...]
    radius: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "centre", _vector("centre", self.centre, (self.dimension,)))
        object.__setattr__(self, "radius", _radius(self.radius))

    def signed_distance(self, place: Axes) -> tuple[Any, Axes]:
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

    def signed_distance(self, place: Axes) -> tuple[Any, Axes]:
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
        object.__setattr__(self, "point", _vector("point", self.point, (1, 2, 3)))
        object.__setattr__(self, "normal", _direction("normal", self.normal, (self.dimension,)))

    @property
    def dimension(self) -> int:
        """1, 2 or 3, as its point has it."""
        return len(self.point)

    def signed_distance(self, place: Axes) -> tuple[Any, Axes]:
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

    def signed_distance(self, place: Axes) -> tuple[Any, Axes]:
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


def obstacle_of(kind: str, **values: Any) -> Obstacle:
    """The obstacle of a kind with its numbers by name, as scene files and `Obstacle.to_dict` have them.

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
        what = "number" if dimensions == (1,) else "numbers"
        raise InputError(f"{name} = {value!r}: expected {' or '.join(map(str, dimensions))} finite {what} [m]")
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
