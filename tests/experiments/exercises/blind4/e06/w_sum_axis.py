"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    kinetic = (string.masses @ (v**2)).sum() / 2
    deltas = np.diff(np.vstack((string.anchor, x)), axis=0)
    ext = np.sqrt((deltas**2).sum(axis=1)) - string.rest_lengths
    elastic = 0.5 * np.sum(string.stiffness * ext) ** 2
    gravitational = string.gravity * (string.masses @ x)[1]
    return kinetic, elastic, gravitational


def power(x, v, string):
    """What damping adds to the energy [W]."""
    deltas = np.diff(np.vstack((string.anchor, x)), axis=0)
    dvel = np.diff(np.vstack(([0.0, 0.0], v)), axis=0)
    rate2 = (deltas * dvel).sum(axis=1) ** 2 / (deltas**2).sum(axis=1)
    return -(string.damping @ rate2) - string.drag * (v**2).sum()


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
