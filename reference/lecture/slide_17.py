"""The circle of slide 17: its rule as it is meant, and as it is printed. Neither is that of `obstacles`."""

from __future__ import annotations

from dataclasses import dataclass

from reference.axes import Axes, dot
from reference.obstacles import Circle


@dataclass(frozen=True)
class CircleAsMeant(Circle):
    """A circle that leaves a mass inside the part of its velocity along it: v - (v.n) n, whichever way v.n leads."""

    def contact_response(self, velocity: Axes, normal: Axes) -> Axes:
        """See Obstacle."""
        across = dot(velocity, normal)
        return [v - across * n for v, n in zip(velocity, normal, strict=True)]


@dataclass(frozen=True)
class CircleAsPrinted(Circle):
    """A circle that multiplies each component of v by that of t = (n_y, -n_x).

    That is no projection: (v_x t_x, v_y t_y) in place of (v.t) t.
    """

    def contact_response(self, velocity: Axes, normal: Axes) -> Axes:
        """See Obstacle."""
        return [velocity[0] * normal[1], velocity[1] * (-1.0 * normal[0])]
