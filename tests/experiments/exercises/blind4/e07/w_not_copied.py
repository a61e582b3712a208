"""Exercise 7: the barrier. Run me: python barrier.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    """Positions x [m] and velocities v [m/s], shape (n, 2), after they have met the circle."""
    px = x
    pv = v
    for i in range(len(px)):
        d = px[i] - circle.centre
        l = np.linalg.norm(d)
        if l < circle.radius:
            e = d / l
            inward = np.dot(pv[i], -e)
            if inward > 0:
                pv[i] = pv[i] + inward * e
            px[i] = circle.centre + circle.radius * e
    return px, pv


if __name__ == "__main__":
    circle = SimpleNamespace(centre=np.array([0.5, 0.0]), radius=0.3)
    x = np.array([[0.5, 0.25], [0.3, 0.0], [0.0, 0.0]])
    v = np.array([[0.5, -1.0], [0.5, -1.0], [0.5, -1.0]])
    print(*push_out(x, v, circle), sep="\n")
