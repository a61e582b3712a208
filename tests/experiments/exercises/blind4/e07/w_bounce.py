"""Exercise 7: the barrier. Run me: python barrier.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    """Positions x [m] and velocities v [m/s], shape (n, 2), after they have met the circle."""
    x, v = np.array(x), np.array(v)
    d = x - circle.centre
    r = np.hypot(d[:, 0], d[:, 1])
    hit = r < circle.radius
    n = d[hit] / r[hit, None]
    x[hit] = circle.centre + n * circle.radius
    vn = (v[hit] * n).sum(axis=1)
    vn[vn > 0] = 0
    v[hit] -= 2 * vn[:, None] * n
    return x, v


if __name__ == "__main__":
    circle = SimpleNamespace(centre=np.array([0.5, 0.0]), radius=0.3)
    x = np.array([[0.5, 0.25], [0.3, 0.0], [0.0, 0.0]])
    v = np.array([[0.5, -1.0], [0.5, -1.0], [0.5, -1.0]])
    print(*push_out(x, v, circle), sep="\n")
