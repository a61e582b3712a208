"""The rule of obstacles: hard, without friction, and they do not move.

A mass that is inside is projected straight out onto the surface and loses the part of its velocity that leads inwards,
no more: an obstacle pushes and never pulls. (Slide 17 takes what leads outwards too, and prints another rule again:
`lecture.slide_17`. `springlab run barrier` shows what comes of each.)

There is one definition of each kind: its signed distance, written for numbers, one per axis. NumPy runs it on arrays of
them, and `compiled.tracing` on symbols, to make of it a part of the loops that advance large systems.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
import numpy.typing as npt

from reference.axes import Axes, axes_of, dot, vectors_of
from reference.state import Array


@dataclass(frozen=True)
class Obstacle:
    """What all kinds have in common. Their fields are numbers, or tuples of numbers."""

    @property
    def kind(self) -> str:
        """What it is called in scene files, and as a capability of engines."""
        return type(self).__name__.lower()

    @property
    def dimension(self) -> int:
        """Of the space it stands in: 1, 2 or 3."""
        raise NotImplementedError

    def signed_distance(self, place: Axes) -> tuple[Any, Axes]:
        """How far a place [m] is from the surface [m], negative inside; the unit normal outwards there.

        All that distinguishes one kind from another. It works on numbers, arrays and symbols alike: of Python it may
        use + - * / < > and &, of NumPy what `compiled.expressions.OPERATIONS` has: for a choice `np.where`, never `if`.
        Where there is no way straight out (at a centre), a normal is chosen.
        """
        raise NotImplementedError

    def contact_response(self, velocity: Axes, normal: Axes) -> Axes:
        """The velocity [m/s] of a mass inside after it has met the obstacle: v - min(v.n, 0) n. No mass gains speed."""
        inwards = dot(velocity, normal)
        inwards = np.where(inwards < 0, inwards, 0.0)
        return [v - inwards * n for v, n in zip(velocity, normal, strict=True)]

    def project(self, place: Axes, velocity: Axes, free: Any) -> tuple[Axes, Axes]:
        """The rule: with g < 0 the signed distance and n the normal, x becomes x - g n, and v the contact response.

        Args:
            place: [m]. velocity: [m/s]. free: whether the mass can move.
        """
        distance, normal = self.signed_distance(place)
        inside = free & (distance < 0)
        moved = [np.where(inside, x - distance * n, x) for x, n in zip(place, normal, strict=True)]
        velocities = zip(self.contact_response(velocity, normal), velocity, strict=True)
        return moved, [np.where(inside, after, before) for after, before in velocities]

    def signed_distances(self, positions: Array) -> tuple[Array, Array]:
        """How far positions (..., d) are from the surface [m], (..., 1), and the normals outwards there, (..., d)."""
        distance, normal = self.signed_distance(axes_of(positions))
        return np.asarray(distance)[..., None], vectors_of(normal, positions)

    def projected(self, positions: Array, velocities: Array) -> tuple[Array, Array]:
        """The rule for free masses, positions [m] and velocities [m/s] of the shape (..., d)."""
        place, velocity = self.project(axes_of(positions), axes_of(velocities), True)
        return vectors_of(place, positions), vectors_of(velocity, velocities)

    def to_dict(self) -> dict[str, Any]:
        """Its kind and its numbers by name, as `obstacle` takes them."""
        values = {f.name: getattr(self, f.name) for f in fields(self)}
        return {"kind": self.kind, **{name: list(v) if isinstance(v, tuple) else v for name, v in values.items()}}


def project_out(
    obstacles: Iterable[Obstacle], fixed: npt.NDArray[np.bool_], positions: Array, velocities: Array
) -> tuple[Array, Array]:
    """The end of every step: the free masses projected out of each obstacle in turn, in the order they are listed.

    In a corner of two obstacles the last one has its way, and the next step goes on from there.

    Args:
        fixed: which masses never move, a shape that goes with (..., d). Those may stand inside.
        positions: shape (..., d) [m]. velocities: the same shape [m/s]. Neither is written to.
    """
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):  # of what has blown up
        place, velocity, free = axes_of(positions), axes_of(velocities), ~fixed[..., 0]
        for obstacle in obstacles:
            place, velocity = obstacle.project(place, velocity, free)
    return vectors_of(place, positions), vectors_of(velocity, velocities)
