"""Exercise 3: the forces on a string. Run me: python forces.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 3


def tension(a, b, k, l0):
    """pull on a towards b"""
    d = b - a
    l = np.sqrt(d @ d)
    return k * (l - l0) * d / l


def forces(x, v, string):
    """The force on every mass [N], shape (n, 2)."""
    n = x.shape[0]
    F = -string.drag * v
    F[:, 0] -= string.masses * string.gravity
    F[0] += tension(x[0], string.anchor, string.stiffness[0], string.rest_lengths[0])
    for j in range(1, n):
        T = tension(x[j], x[j - 1], string.stiffness[j], string.rest_lengths[j])
        F[j] += T
        F[j - 1] -= T
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
