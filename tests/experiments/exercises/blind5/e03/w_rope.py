"""Exercise 3: the forces on a string. Run me: python forces.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 3


def forces(x, v, string):
    """The force on every mass [N], shape (n, 2)."""
    f = np.zeros_like(x)
    f[:, 1] = -string.masses * string.gravity
    f -= string.drag * v

    above = string.anchor
    for i, here in enumerate(x):
        delta = here - above
        length = np.hypot(*delta)
        tension = max(0.0, string.stiffness[i] * (length - string.rest_lengths[i]))
        pull = tension * delta / length
        f[i] -= pull
        if i > 0:
            f[i - 1] += pull
        above = here
    return f


if __name__ == "__main__":
    string = SimpleNamespace(
        masses=np.full(3, 0.05),
        stiffness=np.full(3, 50.0),
        rest_lengths=np.full(3, 0.15),
        drag=0.02,
        gravity=9.81,
        anchor=np.array([0.1, 0.2]),
    )
    x = string.anchor + np.array([[0.15, 0.0], [0.3, 0.0], [0.45, 0.0]])
    v = np.zeros((3, 2))
    print(forces(x, v, string))
