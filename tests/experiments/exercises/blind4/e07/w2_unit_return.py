"""Exercise 7: the barrier. Run me: python barrier.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    """Positions x [m] and velocities v [m/s], shape (n, 2), after they have met the circle."""
    a, b = [], []
    for p, u in zip(x, v):
        n = p - circle.centre
        dist = np.linalg.norm(n)
        if dist < circle.radius:
            p = p + circle.radius * n / dist
            s = np.dot(u, n)
            if s < 0:
                u = u - s * n
        a.append(p)
        b.append(u)
    return np.array(a), np.array(b)


if __name__ == "__main__":
    circle = SimpleNamespace(centre=np.array([0.5, 0.0]), radius=0.3)
    x = np.array([[0.5, 0.25], [0.3, 0.0], [0.0, 0.0]])
    v = np.array([[0.5, -1.0], [0.5, -1.0], [0.5, -1.0]])
    print(*push_out(x, v, circle), sep="\n")
