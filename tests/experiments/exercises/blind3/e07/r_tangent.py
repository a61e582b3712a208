"""Exercise 7: the barrier. Run me: python barrier.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    """Positions x [m] and velocities v [m/s], shape (n, 2), after they have met the circle."""
    d = x - circle.centre
    angle = np.arctan2(d[:, 1], d[:, 0])
    n = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    t = np.stack([-n[:, 1], n[:, 0]], axis=1)
    vt = np.einsum("ij,ij->i", v, t)
    vn = np.einsum("ij,ij->i", v, n).clip(min=0)
    inside = (np.einsum("ij,ij->i", d, d) < circle.radius**2)[:, None]
    x_new = np.where(inside, circle.centre + circle.radius * n, x)
    v_new = np.where(inside, vt[:, None] * t + vn[:, None] * n, v)
    return x_new, v_new


if __name__ == "__main__":
    circle = SimpleNamespace(centre=np.array([0.5, 0.0]), radius=0.3)
    x = np.array([[0.5, 0.25], [0.3, 0.0], [0.0, 0.0]])
    v = np.array([[0.5, -1.0], [0.5, -1.0], [0.5, -1.0]])
    print(*push_out(x, v, circle), sep="\n")
