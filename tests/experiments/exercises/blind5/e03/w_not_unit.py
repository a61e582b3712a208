"""Exercise 3: the forces on a string. Run me: python forces.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 3


def spring_force(a, b, k, l0):
    """Force on a by the spring between a and b."""
    direction = b - a
    length = np.sqrt(direction @ direction)
    return k * (length - l0) * direction


def forces(x, v, string):
    """The force on every mass [N], shape (n, 2)."""
    n = len(x)
    result = -string.drag * v
    result[:, 1] -= string.masses * string.gravity
    result[0] += spring_force(x[0], string.anchor, string.stiffness[0], string.rest_lengths[0])
    for i in range(1, n):
        F = spring_force(x[i], x[i - 1], string.stiffness[i], string.rest_lengths[i])
        result[i] += F
        result[i - 1] -= F
    return result


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
