"""Exercise 3: the forces on a string. Run me: python forces.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 3


def forces(x, v, string):
    """The force on every mass [N], shape (n, 2)."""
    n = x.shape[0]
    nodes = np.concatenate((string.anchor.reshape(1, 2), x))
    seg = np.diff(nodes, axis=0)
    lengths = np.sqrt((seg**2).sum(axis=1))
    units = seg / lengths[:, np.newaxis]
    tension = string.stiffness * (lengths - string.rest_lengths)
    t = tension[:, np.newaxis] * units
    total = np.zeros((n, 2))
    total -= t
    total[:-1] += t[1:]
    total += -string.masses[:, np.newaxis] * (np.array([0.0, string.gravity]) + string.drag * v)
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
