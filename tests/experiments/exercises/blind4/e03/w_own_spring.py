"""Exercise 3: the forces on a string. Run me: python forces.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 3


def forces(x, v, string):
    """The force on every mass [N], shape (n, 2)."""
    k = string.stiffness
    L = string.rest_lengths
    n = len(x)
    result = np.zeros((n, 2))
    for i in range(n):
        above = string.anchor if i == 0 else x[i - 1]
        r = above - x[i]
        d = np.linalg.norm(r)
        result[i] = k[i] * (d - L[i]) * r / d
        if i < n - 1:
            r = x[i + 1] - x[i]
            d = np.linalg.norm(r)
            result[i] += k[i] * (d - L[i + 1]) * r / d
        result[i] += [0.0, -string.masses[i] * string.gravity]
        result[i] += -string.drag * v[i]
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
