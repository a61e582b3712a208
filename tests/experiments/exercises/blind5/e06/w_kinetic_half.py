"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def lengths(x, string):
    previous = np.vstack([string.anchor, x[:-1]])
    return np.linalg.norm(x - previous, axis=1)


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    kinetic = np.sum(string.masses[:, None] * v ** 2)
    elastic = np.sum(string.stiffness / 2 * (lengths(x, string) - string.rest_lengths) ** 2)
    gravitational = np.sum(string.masses * string.gravity * x[:, 1])
    return kinetic, elastic, gravitational


def power(x, v, string):
    """What damping adds to the energy [W]."""
    d = x - np.vstack([string.anchor, x[:-1]])
    dv = v - np.vstack([np.zeros(2), v[:-1]])
    rate = (d * dv).sum(axis=1) / lengths(x, string)
    return -np.sum(string.damping * rate ** 2) - string.drag * np.sum(v ** 2)


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
