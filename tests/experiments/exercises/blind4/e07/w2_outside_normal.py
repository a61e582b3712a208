"""Exercise 7: the barrier. Run me: python barrier.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    """Positions x [m] and velocities v [m/s], shape (n, 2), after they have met the circle."""
    r = x - circle.centre
    d = np.sqrt((r**2).sum(axis=1))[:, None]
    n = r / d
    inside = (d < circle.radius)[:, 0]
    x2 = x.copy()
    x2[inside] = circle.centre - circle.radius * n[inside]
    s = (v * n).sum(axis=1)[:, None]
    v2 = v - np.minimum(s, 0) * n
    return x2, v2


if __name__ == "__main__":
    circle = SimpleNamespace(centre=np.array([0.5, 0.0]), radius=0.3)
    x = np.array([[0.5, 0.25], [0.3, 0.0], [0.0, 0.0]])
    v = np.array([[0.5, -1.0], [0.5, -1.0], [0.5, -1.0]])
    print(*push_out(x, v, circle), sep="\n")
