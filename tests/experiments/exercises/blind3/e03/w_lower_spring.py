"""Exercise 3: the forces on a string. Run me: python forces.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 3


def spring_force(a, b, k, L):
    """Force on a from the spring to b."""
    d = b - a
    l = np.sqrt(d[0] ** 2 + d[1] ** 2)
    return k * (l - L) * d / l


def forces(x, v, string):
    """The force on every mass [N], shape (n, 2)."""
    n = len(x)
    F = np.zeros((n, 2))
    for i in range(n):
        up = string.anchor if i == 0 else x[i - 1]
        F[i] += spring_force(x[i], up, string.stiffness[i], string.rest_lengths[i])
        if i < n - 1:
            F[i] += spring_force(x[i], x[i + 1], string.stiffness[i], string.rest_lengths[i + 1])
        F[i] += np.array([0, -string.masses[i] * string.gravity])
        F[i] -= string.drag * v[i]
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
