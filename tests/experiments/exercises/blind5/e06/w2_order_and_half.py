"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6

norm = lambda a: np.sqrt((a * a).sum(axis=-1))


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    top = np.vstack((string.anchor, x))[:-1]
    kinetic = (0.5 * string.masses * norm(v) ** 2).sum()
    springs = (string.stiffness * (norm(x - top) - string.rest_lengths) ** 2).sum()
    weight = (string.masses * string.gravity * x[:, 1]).sum()
    return kinetic, weight, springs


def power(x, v, string):
    """What damping adds to the energy [W]."""
    top = np.vstack((string.anchor, x))[:-1]
    top_v = np.vstack((np.zeros(2), v))[:-1]
    rate = ((x - top) * (v - top_v)).sum(axis=-1) / norm(x - top)
    return -(string.damping * rate ** 2).sum() - (string.drag * norm(v) ** 2).sum()


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
