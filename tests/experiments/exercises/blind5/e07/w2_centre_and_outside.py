"""Exercise 7: the barrier. Run me: python barrier.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    """Positions x [m] and velocities v [m/s], shape (n, 2), after they have met the circle."""
    x, v = x.copy(), v.copy()
    for i in range(len(x)):
        d = x[i] - circle.centre
        r = np.linalg.norm(d)
        n = d / r
        if r < circle.radius:
            x[i] = circle.radius * n
        if v[i] @ n < 0:
            v[i] -= (v[i] @ n) * n
    return x, v


if __name__ == "__main__":
    circle = SimpleNamespace(centre=np.array([0.5, 0.0]), radius=0.3)
    x = np.array([[0.5, 0.25], [0.3, 0.0], [0.0, 0.0]])
    v = np.array([[0.5, -1.0], [0.5, -1.0], [0.5, -1.0]])
    print(*push_out(x, v, circle), sep="\n")
