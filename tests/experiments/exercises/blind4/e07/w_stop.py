"""Exercise 7: the barrier. Run me: python barrier.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    """Positions x [m] and velocities v [m/s], shape (n, 2), after they have met the circle."""
    new_x = x.copy()
    new_v = v.copy()
    for i, (p, u) in enumerate(zip(x, v)):
        to_mass = p - circle.centre
        distance = np.sqrt(to_mass[0] ** 2 + to_mass[1] ** 2)
        if distance >= circle.radius:
            continue
        e = to_mass / distance
        new_x[i] = circle.centre + circle.radius * e
        if u @ e < 0:
            new_v[i] = 0
    return new_x, new_v


if __name__ == "__main__":
    circle = SimpleNamespace(centre=np.array([0.5, 0.0]), radius=0.3)
    x = np.array([[0.5, 0.25], [0.3, 0.0], [0.0, 0.0]])
    v = np.array([[0.5, -1.0], [0.5, -1.0], [0.5, -1.0]])
    print(*push_out(x, v, circle), sep="\n")
