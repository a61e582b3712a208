"""Exercise 7: the barrier. Run me: python barrier.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 7


def normal_and_depth(x, circle):
    d = x - circle.centre
    r = np.linalg.norm(d, axis=1)
    return d / r[:, None], circle.radius - r


def push_out(x, v, circle):
    """Positions x [m] and velocities v [m/s], shape (n, 2), after they have met the circle."""
    n, depth = normal_and_depth(x, circle)
    inside = depth > 0
    radial = np.einsum("ij,ij->i", v, n)
    x_new = x + np.where(inside, depth, 0.0)[:, None] * n
    v_new = v.copy()
    for i in np.flatnonzero(inside):
        if radial[i] > 0:
            v_new[i] -= radial[i] * n[i]
    return x_new, v_new


if __name__ == "__main__":
    circle = SimpleNamespace(centre=np.array([0.5, 0.0]), radius=0.3)
    x = np.array([[0.5, 0.25], [0.3, 0.0], [0.0, 0.0]])
    v = np.array([[0.5, -1.0], [0.5, -1.0], [0.5, -1.0]])
    print(*push_out(x, v, circle), sep="\n")
