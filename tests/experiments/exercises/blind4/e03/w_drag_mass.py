"""Exercise 3: the forces on a string. Run me: python forces.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 3


G = np.array([0.0, -1.0])


def forces(x, v, string):
    """The force on every mass [N], shape (n, 2)."""
    m = string.masses[:, None]
    up = x - np.roll(x, 1, axis=0)
    up[0] = x[0] - string.anchor
    l = np.linalg.norm(up, axis=1)[:, None]
    T = string.stiffness[:, None] * (l - string.rest_lengths[:, None]) * up / l
    net = np.roll(T, -1, axis=0)
    net[-1] = 0
    net -= T
    net += m * (string.gravity * G - string.drag * v)
    return net


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
