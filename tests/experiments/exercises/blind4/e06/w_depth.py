"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    m = string.masses
    r = x.copy()
    r[1:] -= x[:-1]
    r[0] -= string.anchor
    s = np.sqrt((r * r).sum(1)) - string.rest_lengths
    E_k = (m * (v * v).sum(1)).sum() / 2
    E_s = (string.stiffness * s * s).sum() / 2
    h = x[:, 1] - string.anchor[1]
    E_g = (m * h).sum() * string.gravity
    return E_k, E_s, E_g


def power(x, v, string):
    """What damping adds to the energy [W]."""
    r = x.copy()
    r[1:] -= x[:-1]
    r[0] -= string.anchor
    w = v.copy()
    w[1:] -= v[:-1]
    along = (r * w).sum(1) / np.sqrt((r * r).sum(1))
    return -(string.damping * along * along).sum() - string.drag * (v * v).sum()


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
