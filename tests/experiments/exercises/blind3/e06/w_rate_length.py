"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def geometry(x, v, string):
    d = x.copy()
    d[0] -= string.anchor
    d[1:] -= x[:-1]
    dv = v.copy()
    dv[1:] -= v[:-1]
    length = np.linalg.norm(d, axis=1)
    rate = (d * dv).sum(axis=1)
    return length, rate


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    length, _ = geometry(x, v, string)
    kinetic = np.sum(string.masses[:, None] * v * v) / 2
    elastic = np.sum(string.stiffness * np.square(length - string.rest_lengths)) / 2
    height = np.sum(string.masses * x[:, 1]) * string.gravity
    return float(kinetic), float(elastic), float(height)


def power(x, v, string):
    """What damping adds to the energy [W]."""
    _, rate = geometry(x, v, string)
    return float(-np.sum(string.damping * rate * rate) - string.drag * np.sum(v * v))


if __name__ == "__main__":
    string = SimpleNamespace(
        masses=np.full(3, 0.05),
        stiffness=np.full(3, 50.0),
        rest_lengths=np.full(3, 0.15),
        damping=np.full(3, 0.05),
        drag=0.02,
        gravity=9.81,
        anchor=np.array([0.1, 0.2]),
    )
    x = string.anchor + np.array([[0.15, 0.0], [0.3, 0.0], [0.45, 0.0]])
    v = np.zeros((3, 2))
    v[:, 1] = -1.0
    print(energy(x, v, string), power(x, v, string))
