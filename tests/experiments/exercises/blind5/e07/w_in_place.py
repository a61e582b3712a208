"""Exercise 7: the barrier. Run me: python barrier.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    """Positions x [m] and velocities v [m/s], shape (n, 2), after they have met the circle."""
    offset = x - circle.centre
    dist = np.sqrt((offset ** 2).sum(axis=1))
    inside = dist < circle.radius
    normal = offset / dist[:, None]

    x[inside] = circle.centre + circle.radius * normal[inside]
    radial = (v * normal).sum(axis=1)
    hit = inside & (radial < 0)
    v[hit] -= radial[hit, None] * normal[hit]
    return x, v


if __name__ == "__main__":
    circle = SimpleNamespace(centre=np.array([0.5, 0.0]), radius=0.3)
    x = np.array([[0.5, 0.25], [0.3, 0.0], [0.0, 0.0]])
    v = np.array([[0.5, -1.0], [0.5, -1.0], [0.5, -1.0]])
    print(*push_out(x, v, circle), sep="\n")
