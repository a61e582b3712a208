"""Exercise 3: the forces on a string. Run me: python forces.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 3


def forces(x, v, string):
    points = np.vstack((string.anchor, x))
    d = points[:-1] - points[1:]
    L = np.linalg.norm(d, axis=1)
    u = d / np.linalg.norm(d)
    s = (string.stiffness * (L - string.rest_lengths)).reshape(-1, 1) * u
    below = np.vstack((s[1:], np.zeros((1, 2))))
    weight = np.column_stack((np.zeros(len(x)), -string.masses * string.gravity))
    return s - below + weight - string.drag * v


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
