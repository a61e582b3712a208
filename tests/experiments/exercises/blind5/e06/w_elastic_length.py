"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def link_vectors(points, first):
    return np.concatenate([[points[0] - first], points[1:] - points[:-1]])


def kinetic(v, masses):
    return 0.5 * np.sum(masses * np.sum(v * v, axis=1))


def elastic(x, string):
    links = link_vectors(x, string.anchor)
    length2 = np.sum(links * links, axis=1)
    return 0.5 * np.sum(string.stiffness * length2)


def gravitational(x, string):
    return string.gravity * np.dot(string.masses, x[:, 1])


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    return kinetic(v, string.masses), elastic(x, string), gravitational(x, string)


def power(x, v, string):
    """What damping adds to the energy [W]."""
    links = link_vectors(x, string.anchor)
    rates = link_vectors(v, np.zeros(2))
    along = np.sum(links * rates, axis=1) / np.sqrt(np.sum(links * links, axis=1))
    return -np.sum(string.damping * along * along) - string.drag * np.sum(v * v)


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
