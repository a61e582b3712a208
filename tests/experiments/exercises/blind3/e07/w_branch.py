"""Exercise 7: the barrier. Run me: python barrier.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    """Positions x [m] and velocities v [m/s], shape (n, 2), after they have met the circle."""
    rel = x - circle.centre
    dist = np.sqrt((rel**2).sum(axis=1))
    inside = dist < circle.radius
    normal = rel[inside] / dist[inside][:, None]
    new_x = np.array(x)
    new_v = np.array(v)
    new_x[inside] = circle.centre + circle.radius * normal
    speed_out = (v[inside] * normal).sum(axis=1)
    lost = np.maximum(speed_out, 0)
    new_v[inside] = v[inside] - lost[:, None] * normal
    return new_x, new_v


if __name__ == "__main__":
    circle = SimpleNamespace(centre=np.array([0.5, 0.0]), radius=0.3)
    x = np.array([[0.5, 0.25], [0.3, 0.0], [0.0, 0.0]])
    v = np.array([[0.5, -1.0], [0.5, -1.0], [0.5, -1.0]])
    print(*push_out(x, v, circle), sep="\n")
