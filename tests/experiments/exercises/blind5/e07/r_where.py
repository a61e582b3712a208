"""Exercise 7: the barrier. Run me: python barrier.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    """Positions x [m] and velocities v [m/s], shape (n, 2), after they have met the circle."""
    d = x - circle.centre
    r = np.linalg.norm(d, axis=1, keepdims=True)
    n = d / r
    inside = r < circle.radius
    inwards = np.minimum(np.sum(v * n, axis=1, keepdims=True), 0.0)
    return np.where(inside, circle.centre + circle.radius * n, x), np.where(inside, v - inwards * n, v)


if __name__ == "__main__":
    circle = SimpleNamespace(centre=np.array([0.5, 0.0]), radius=0.3)
    x = np.array([[0.5, 0.25], [0.3, 0.0], [0.0, 0.0]])
    v = np.array([[0.5, -1.0], [0.5, -1.0], [0.5, -1.0]])
    print(*push_out(x, v, circle), sep="\n")
