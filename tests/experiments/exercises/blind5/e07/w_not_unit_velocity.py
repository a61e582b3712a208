"""Exercise 7: the barrier. Run me: python barrier.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    """Positions x [m] and velocities v [m/s], shape (n, 2), after they have met the circle."""
    px, pv = np.array(x), np.array(v)
    for k, (pos, vel) in enumerate(zip(x, v)):
        rel = pos - circle.centre
        dist = np.hypot(rel[0], rel[1])
        if dist > circle.radius:
            continue
        px[k] = circle.centre + rel * (circle.radius / dist)
        along = vel[0] * rel[0] + vel[1] * rel[1]
        if along < 0:
            pv[k] = vel - along * rel
    return px, pv


if __name__ == "__main__":
    circle = SimpleNamespace(centre=np.array([0.5, 0.0]), radius=0.3)
    x = np.array([[0.5, 0.25], [0.3, 0.0], [0.0, 0.0]])
    v = np.array([[0.5, -1.0], [0.5, -1.0], [0.5, -1.0]])
    print(*push_out(x, v, circle), sep="\n")
