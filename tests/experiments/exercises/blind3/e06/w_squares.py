"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def lengths(x, string):
    d = np.diff(np.vstack([string.anchor, x]), axis=0)
    return np.linalg.norm(d, axis=1), d


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    l, _ = lengths(x, string)
    kin = 0.5 * np.sum(string.masses * np.sum(v**2, axis=1))
    ela = 0.5 * np.sum(string.stiffness * (l**2 - string.rest_lengths**2))
    pot = np.sum(string.masses * string.gravity * x[:, 1])
    return kin, ela, pot


def power(x, v, string):
    """What damping adds to the energy [W]."""
    l, d = lengths(x, string)
    dv = np.diff(np.vstack([np.zeros(2), v]), axis=0)
    rate = np.sum(d * dv, axis=1) / l
    return -np.sum(string.damping * rate**2) - string.drag * np.sum(v**2)


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
