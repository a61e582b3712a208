"""Exercise 3: the forces on a string. Run me: python forces.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 3


def forces(x, v, string):
    """The force on every mass [N], shape (n, 2)."""
    d = x.copy()
    d[0] = x[0] - string.anchor
    d[1:] = x[1:] - x[:-1]

    L = np.linalg.norm(d)
    e = d / L
    T = string.stiffness * (L - string.rest_lengths)

    f = np.zeros(x.shape)
    f -= T[:, None] * e
    f[:-1] += T[1:, None] * e[1:]
    f -= string.drag * v
    f[:, 1] -= string.gravity * string.masses
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
