"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def rel(a, first):
    """Difference of each to the one above."""
    out = np.empty_like(a)
    out[0] = a[0] - first
    out[1:] = a[1:] - a[:-1]
    return out


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    e = np.linalg.norm(rel(x, string.anchor), axis=1) - string.rest_lengths
    return (
        float(0.5 * (string.masses * v[:, 0] ** 2 + string.masses * v[:, 1] ** 2).sum()),
        float(0.5 * (string.stiffness * e**2).sum()),
        float((string.masses * string.gravity * x[:, 1]).sum()),
    )


def power(x, v, string):
    """What damping adds to the energy [W]."""
    dx = rel(x, string.anchor)
    dv = rel(v, 0.0)
    rate = np.sum(dx * dv, axis=1)
    return float(-(string.damping * rate**2).sum() - string.drag * (v**2).sum())


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
