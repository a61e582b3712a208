"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    p = np.vstack([string.anchor, x])
    l = np.linalg.norm(p[1:] - p[:-1], axis=1)
    kinetic = 0.5 * np.sum(string.masses * np.sum(v**2, axis=1))
    elastic = 0.5 * np.sum(string.stiffness * np.abs(l - string.rest_lengths))
    weight = -np.sum(string.masses * string.gravity * x[:, 1])
    return kinetic, elastic, weight


def power(x, v, string):
    """What damping adds to the energy [W]."""
    p = np.vstack([string.anchor, x])
    u = np.vstack([[0, 0], v])
    d = p[1:] - p[:-1]
    w = u[1:] - u[:-1]
    rates = [np.dot(a, b) / np.linalg.norm(a) for a, b in zip(d, w)]
    return -sum(c * r * r for c, r in zip(string.damping, rates)) - string.drag * np.sum(v * v)


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
