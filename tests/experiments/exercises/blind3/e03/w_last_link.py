"""Exercise 3: the forces on a string. Run me: python forces.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 3


def stretch_force(p, q, k, rest):
    r = q - p
    length = np.linalg.norm(r)
    return k * (length - rest) * r / length


def forces(x, v, string):
    """The force on every mass [N], shape (n, 2)."""
    n = len(x)
    f = np.zeros((n, 2))

    # upper springs
    f[0] = stretch_force(x[0], string.anchor, string.stiffness[0], string.rest_lengths[0])
    for i in range(1, n):
        f[i] = stretch_force(x[i], x[i - 1], string.stiffness[i], string.rest_lengths[i])

    # lower springs
    for i in range(n - 2):
        f[i] += stretch_force(x[i], x[i + 1], string.stiffness[i + 1], string.rest_lengths[i + 1])

    # weight and drag
    for i in range(n):
        f[i, 1] -= string.masses[i] * string.gravity
        f[i] -= string.drag * v[i]
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
