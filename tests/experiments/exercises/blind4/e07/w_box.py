"""Exercise 7: the barrier. Run me: python barrier.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    """Positions x [m] and velocities v [m/s], shape (n, 2), after they have met the circle."""
    R = circle.radius
    xs, vs = x.copy(), v.copy()
    rel = x - circle.centre
    inside = np.all(np.abs(rel) < R, axis=1)
    for i in np.where(inside)[0]:
        n = rel[i] / np.linalg.norm(rel[i])
        xs[i] = circle.centre + R * n
        s = vs[i].dot(n)
        if s < 0:
            vs[i] = vs[i] - s * n
    return xs, vs


if __name__ == "__main__":
    circle = SimpleNamespace(centre=np.array([0.5, 0.0]), radius=0.3)
    x = np.array([[0.5, 0.25], [0.3, 0.0], [0.0, 0.0]])
    v = np.array([[0.5, -1.0], [0.5, -1.0], [0.5, -1.0]])
    print(*push_out(x, v, circle), sep="\n")
