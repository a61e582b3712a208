"""Exercise 7: the barrier. Run me: python barrier.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    """Positions x [m] and velocities v [m/s], shape (n, 2), after they have met the circle."""
    out_x, out_v = np.empty_like(x), np.empty_like(v)
    for i in range(x.shape[0]):
        r = x[i] - circle.centre
        d = np.linalg.norm(r)
        if d >= circle.radius:
            out_x[i], out_v[i] = x[i], v[i]
        else:
            n = r / d
            out_x[i] = n * circle.radius
            out_v[i] = v[i] - min(0.0, n @ v[i]) * n
    return out_x, out_v


if __name__ == "__main__":
    circle = SimpleNamespace(centre=np.array([0.5, 0.0]), radius=0.3)
    x = np.array([[0.5, 0.25], [0.3, 0.0], [0.0, 0.0]])
    v = np.array([[0.5, -1.0], [0.5, -1.0], [0.5, -1.0]])
    print(*push_out(x, v, circle), sep="\n")
