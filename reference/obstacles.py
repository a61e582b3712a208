"""What masses may not enter: circle, sphere, cylinder, plane, box, with the rule of slides 16-17. Needs NumPy only.

All are hard and without friction, and do not move. The rule: a mass that is inside moves straight out to the surface
and keeps the part of its velocity along it. Slide 17 means that rule, and prints another (`Circle`).
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields
from types import MappingProxyType
from typing import Any

import numpy as np
import numpy.typing as npt

from reference.errors import InputError, unknown_name
from reference.state import Array

#: A mass may start inside by this part of the system's size: a state that was pushed out and rounded is a start too.
ROUNDING = 1e-9


@dataclass(frozen=True)
class Obstacle:
    """What circle, sphere, cylinder and plane have in common."""

    @property
    def kind(self) -> str:
        """What it is called in scene files, and as a capability of engines."""
        return type(self).__name__.lower()

    @property
    def dimension(self) -> int:
        """Of the space it stands in, 2 or 3."""
        raise NotImplementedError

    def gap(self, positions: Array) -> tuple[Array, Array]:
        """How far positions (..., d) are from the surface [m], negative inside, (..., 1); the normals outwards there.

        Where there is no way straight out (at a centre), a normal is chosen.
        """
        raise NotImplementedError

    def push_out(self, positions: Array, velocities: Array) -> tuple[Array, Array]:
        """Masses inside move straight out to the surface and keep the part of their velocity along it.

        With n the unit normal outwards and g < 0 the gap, x becomes x - g n and v becomes v - (v.n) n. No mass gains
        speed.

        Args:
            positions: shape (..., d) [m]. velocities: the same shape [m/s].
        """
        gap, normal = self.gap(positions)
        kept = velocities - (velocities * normal).sum(axis=-1, keepdims=True) * normal
        return np.where(gap < 0, positions - gap * normal, positions), np.where(gap < 0, kept, velocities)

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

    def gap(self, positions: Array) -> tuple[Array, Array]:
        up = np.eye(self.dimension)[1]
        distance, normal = _length_and_direction(positions - np.array(self.centre), up)
        return distance - self.radius, normal


@dataclass(frozen=True)
class Circle(_Ball):
    """A circle in the plane. centre (2,) [m], radius [m]."""

    @property
    def dimension(self) -> int:
        """2."""
        return 2

    def push_out_as_printed(self, positions: Array, velocities: Array) -> tuple[Array, Array]:
        """The rule of slide 17 as it is printed: each component of v is multiplied by that of t = (n_y, -n_x).

        That is no projection: (v_x t_x, v_y t_y) in place of (v.t) t.
        """
        gap, normal = self.gap(positions)
        tangent = np.stack([normal[..., 1], -normal[..., 0]], axis=-1)
        return np.where(gap < 0, positions - gap * normal, positions), np.where(
            gap < 0, velocities * tangent, velocities
        )


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

    def gap(self, positions: Array) -> tuple[Array, Array]:
        """See Obstacle."""
        axis = np.array(self.axis)
        away = positions - np.array(self.centre)
        away = away - (away * axis).sum(axis=-1, keepdims=True) * axis
        across = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
        distance, normal = _length_and_direction(away, across / np.linalg.norm(across))
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

    def gap(self, positions: Array) -> tuple[Array, Array]:
        """See Obstacle."""
        normal = np.array(self.normal)
        above = ((positions - np.array(self.point)) * normal).sum(axis=-1, keepdims=True)
        return above, np.broadcast_to(normal, positions.shape)


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

    def gap(self, positions: Array) -> tuple[Array, Array]:
        """See Obstacle: to the nearest face from inside, to the nearest point, which may be a corner, from outside."""
        away = positions - np.array(self.centre)
        sides = np.where(away < 0, -1.0, 1.0)
        beyond = np.abs(away) - np.array(self.half_sizes)
        nearest = np.eye(self.dimension)[np.argmax(beyond, axis=-1)]
        distance, normal = _length_and_direction(np.maximum(beyond, 0.0), nearest)
        return np.where(distance > 0, distance, beyond.max(axis=-1, keepdims=True)), sides * normal


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
        for barrier in obstacles:
            pushed, kept = barrier.push_out(positions, velocities)
            positions, velocities = np.where(fixed, positions, pushed), np.where(fixed, velocities, kept)
    return positions, velocities


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


def _length_and_direction(away: Array, otherwise: Array) -> tuple[Array, Array]:
    """The lengths (..., 1) of vectors (..., d), and their directions; of no length, `otherwise`."""
    length = np.sqrt((away * away).sum(axis=-1, keepdims=True))
    return length, np.where(length > 0, away / np.where(length > 0, length, 1.0), otherwise)


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
