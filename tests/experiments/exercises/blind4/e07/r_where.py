"""Exercise 7: the barrier. Run me: python barrier.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    """Positions x [m] and velocities v [m/s], shape (n, 2), after they have met the circle."""
    r = x - circle.centre
    d = np.linalg.norm(r, axis=1, keepdims=True)
    inside = d < circle.radius
    n = r / np.where(d > 0, d, 1)
    speed = np.sum(v * n, axis=1, keepdims=True)
    return (np.where(inside, circle.centre + circle.radius * n, x), np.where(inside, v - np.minimum(speed, 0) * n, v))


if __name__ == "__main__":
    circle = SimpleNamespace(centre=np.array([0.5, 0.0]), radius=0.3)
    x = np.array([[0.5, 0.25], [0.3, 0.0], [0.0, 0.0]])
    v = np.array([[0.5, -1.0], [0.5, -1.0], [0.5, -1.0]])
    print(*push_out(x, v, circle), sep="\n")
