"""Exercise 7: the barrier. Run me: python barrier.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    """Positions x [m] and velocities v [m/s], shape (n, 2), after they have met the circle."""
    to_mass = x - circle.centre
    distance = np.linalg.norm(to_mass, axis=1)
    inside = distance < circle.radius
    n = to_mass / distance.reshape(-1, 1)
    speed_out = np.einsum("ij,ij->i", v, n)
    moving_in = speed_out < 0

    out_x = np.array(x)
    out_v = np.array(v)
    out_x[inside] = (circle.centre + circle.radius * n)[inside]
    both = np.logical_and(inside, moving_in)
    out_v[both] = (v - 2 * speed_out.reshape(-1, 1) * n)[both]
    return out_x, out_v


if __name__ == "__main__":
    circle = SimpleNamespace(centre=np.array([0.5, 0.0]), radius=0.3)
    x = np.array([[0.5, 0.25], [0.3, 0.0], [0.0, 0.0]])
    v = np.array([[0.5, -1.0], [0.5, -1.0], [0.5, -1.0]])
    print(*push_out(x, v, circle), sep="\n")
