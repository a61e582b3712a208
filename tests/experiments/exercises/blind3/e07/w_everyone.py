"""Exercise 7: the barrier. Run me: python barrier.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    """Positions x [m] and velocities v [m/s], shape (n, 2), after they have met the circle."""
    d = x - circle.centre
    r = np.linalg.norm(d, axis=1, keepdims=True)
    n = d / r
    x_out = np.where(r < circle.radius, circle.centre + circle.radius * n, x)
    vn = np.sum(v * n, axis=1, keepdims=True)
    v_out = np.where(vn < 0, v - vn * n, v)
    return x_out, v_out


if __name__ == "__main__":
    circle = SimpleNamespace(centre=np.array([0.5, 0.0]), radius=0.3)
    x = np.array([[0.5, 0.25], [0.3, 0.0], [0.0, 0.0]])
    v = np.array([[0.5, -1.0], [0.5, -1.0], [0.5, -1.0]])
    print(*push_out(x, v, circle), sep="\n")
