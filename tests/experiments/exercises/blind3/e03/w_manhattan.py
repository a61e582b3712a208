"""Exercise 3: the forces on a string. Run me: python forces.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 3


def forces(x, v, string):
    """The force on every mass [N], shape (n, 2)."""
    upper = np.roll(x, 1, axis=0)
    upper[0] = string.anchor
    d = upper - x
    length = np.abs(d).sum(axis=1)
    pull = d * (string.stiffness * (length - string.rest_lengths) / length)[:, None]
    f = pull
    f[:-1] = pull[:-1] - pull[1:]
    f[:, 1] -= string.masses * string.gravity
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
