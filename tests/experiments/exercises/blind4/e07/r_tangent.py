"""Exercise 7: the barrier. Run me: python barrier.py."""

from types import SimpleNamespace

import numpy as np
import math

EXERCISE = 7


def push_out(x, v, circle):
    """Positions x [m] and velocities v [m/s], shape (n, 2), after they have met the circle."""
    cx, cy = circle.centre
    xs, vs = [], []
    for (px, py), (ux, uy) in zip(x, v):
        if (px - cx) ** 2 + (py - cy) ** 2 >= circle.radius**2:
            xs.append((px, py))
            vs.append((ux, uy))
            continue
        phi = math.atan2(py - cy, px - cx)
        c, s = math.cos(phi), math.sin(phi)
        out = max(0.0, ux * c + uy * s)
        along = uy * c - ux * s
        xs.append((cx + circle.radius * c, cy + circle.radius * s))
        vs.append((out * c - along * s, out * s + along * c))
    return np.array(xs).reshape(-1, 2), np.array(vs).reshape(-1, 2)


if __name__ == "__main__":
    circle = SimpleNamespace(centre=np.array([0.5, 0.0]), radius=0.3)
    x = np.array([[0.5, 0.25], [0.3, 0.0], [0.0, 0.0]])
    v = np.array([[0.5, -1.0], [0.5, -1.0], [0.5, -1.0]])
    print(*push_out(x, v, circle), sep="\n")
