"""Exercise 7: the barrier. Run me: python barrier.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 7


def unit(a):
    return a / np.hypot(a[0], a[1])


def push_out(x, v, circle):
    """Positions x [m] and velocities v [m/s], shape (n, 2), after they have met the circle."""
    x = np.copy(x)
    v = np.copy(v)
    for i, (p, u) in enumerate(zip(x, v)):
        offset = p - circle.centre
        distance = np.hypot(offset[0], offset[1])
        if distance >= circle.radius:
            continue
        n = unit(offset)
        x[i] = p + 2 * (circle.radius - distance) * n
        v[i] = u - min(0.0, u @ n) * n
    return x, v


if __name__ == "__main__":
    circle = SimpleNamespace(centre=np.array([0.5, 0.0]), radius=0.3)
    x = np.array([[0.5, 0.25], [0.3, 0.0], [0.0, 0.0]])
    v = np.array([[0.5, -1.0], [0.5, -1.0], [0.5, -1.0]])
    print(*push_out(x, v, circle), sep="\n")
