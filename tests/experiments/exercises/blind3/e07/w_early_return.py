"""Exercise 7: the barrier. Run me: python barrier.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    """Positions x [m] and velocities v [m/s], shape (n, 2), after they have met the circle."""
    x_new = x.astype(float).copy()
    v_new = v.astype(float).copy()
    for k in range(len(x_new)):
        vec = x_new[k] - circle.centre
        rho = np.linalg.norm(vec)
        if rho < circle.radius:
            e = vec / rho
            x_new[k] = circle.centre + e * circle.radius
            radial = np.dot(v_new[k], e)
            if radial < 0:
                v_new[k] = v_new[k] - radial * e
            return x_new, v_new
    return x_new, v_new


if __name__ == "__main__":
    circle = SimpleNamespace(centre=np.array([0.5, 0.0]), radius=0.3)
    x = np.array([[0.5, 0.25], [0.3, 0.0], [0.0, 0.0]])
    v = np.array([[0.5, -1.0], [0.5, -1.0], [0.5, -1.0]])
    print(*push_out(x, v, circle), sep="\n")
