"""Exercise 3: the forces on a string. Run me: python forces.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 3


def forces(x, v, string):
    """The force on every mass [N], shape (n, 2)."""
    f = np.zeros_like(x)
    for i in range(len(x)):
        if i == 0:
            upper = string.anchor
        else:
            upper = x[i - 1]
        d = upper - x[i]
        length = np.linalg.norm(d)
        f[i] += string.stiffness[i] * (length - string.rest_lengths[i]) * d / length
        f[i] -= string.drag * v[i]
        f[i, 1] -= string.masses[i] * string.gravity
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
