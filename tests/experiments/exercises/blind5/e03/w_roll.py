"""Exercise 3: the forces on a string. Run me: python forces.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 3


def forces(x, v, string):
    """The force on every mass [N], shape (n, 2)."""
    points = np.concatenate([string.anchor[np.newaxis], x])
    d = points[:-1] - points[1:]
    length = np.linalg.norm(d, axis=1, keepdims=True)
    k = string.stiffness.reshape(-1, 1)
    l0 = string.rest_lengths.reshape(-1, 1)
    up = k * (length - l0) * d / length
    down = np.roll(up, -1, axis=0)
    F = up - down - string.drag * v
    F[:, 1] -= string.masses * string.gravity
    return F


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
