"""What a mass may not enter: the circle of slides 16-17, with the rule that is right and the rule as it is printed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from reference.state import Array


@dataclass(frozen=True)
class Circle:
    """A frictionless circle. centre (2,) [m], radius [m]."""

    centre: tuple[float, float]
    radius: float

    def push_out(self, positions: Array, velocities: Array) -> tuple[Array, Array]:
        """Masses inside move straight out to the circle and keep the part of their velocity along it.

        With the unit normal n outwards, x becomes centre + radius n, and v becomes v - (v.n) n, which is (v.t) t.

        Args:
            positions: shape (n, 2) [m]. velocities: shape (n, 2) [m/s].
        """
        inside, normal = self._normals(positions)
        kept = velocities - (velocities * normal).sum(axis=1, keepdims=True) * normal
        return self._on(positions, inside, normal), np.where(inside, kept, velocities)

    def push_out_as_printed(self, positions: Array, velocities: Array) -> tuple[Array, Array]:
        """The rule of slide 17 as it is printed: each component of v is multiplied by that of t = (n_y, -n_x).

        That is no projection: (v_x t_x, v_y t_y) in place of (v.t) t.
        """
        inside, normal = self._normals(positions)
        tangent = np.stack([normal[:, 1], -normal[:, 0]], axis=1)
        return self._on(positions, inside, normal), np.where(inside, velocities * tangent, velocities)

    def _normals(self, positions: Array) -> tuple[Array, Array]:
        """Which masses are inside, shape (n, 1), and the directions from the centre to all masses, shape (n, 2)."""
        away = positions - np.array(self.centre)
        distance = np.linalg.norm(away, axis=1, keepdims=True)
        return distance < self.radius, np.divide(away, distance, out=np.zeros_like(away), where=distance > 0)

    def _on(self, positions: Array, inside: Array, normal: Array) -> Array:
        return np.where(inside, np.array(self.centre) + self.radius * normal, positions)
