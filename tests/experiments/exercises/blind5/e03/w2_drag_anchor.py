"""Exercise 3: the forces on a string. Run me: python forces.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 3


def forces(x, v, string):
    """The force on every mass [N], shape (n, 2)."""
    previous = np.zeros_like(x)
    previous[1:] = x[:-1]
    r = previous - x
    dist = np.sqrt((r ** 2).sum(axis=1))
    mag = string.stiffness * (dist - string.rest_lengths)
    pull = mag[:, None] * r / dist[:, None]
    total = pull + string.drag * v
    total[:-1] -= pull[1:]
    total[:, 1] -= string.masses * string.gravity
    return total


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
