"""Exercise 3: the forces on a string. Run me: python forces.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 3


def forces(x, v, string):
    """The force on every mass [N], shape (n, 2)."""
    upper = np.vstack((string.anchor, x[:-1]))
    d = upper - x
    length = np.sqrt((d**2).sum(axis=1))
    size = string.stiffness * (length - string.rest_lengths)
    F = size[:, np.newaxis] * d
    out = F.copy()
    out[:-1] -= F[1:]
    out[:, 1] -= string.gravity * string.masses
    out -= string.drag * v
    return out


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
