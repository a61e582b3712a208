"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    all_x = np.vstack([string.anchor, x])
    l = np.linalg.norm(all_x[1:] - all_x[:-1], axis=1)
    e_k = 0.5 * np.sum(string.masses * np.linalg.norm(v, axis=1) ** 2)
    e_s = 0.5 * np.sum(string.stiffness * (l - string.rest_lengths) ** 2)
    e_g = np.sum(string.masses * string.gravity * (x[:, 1] - string.anchor[1]))
    return e_k, e_s, e_g


def power(x, v, string):
    """What damping adds to the energy [W]."""
    all_x = np.vstack([string.anchor, x])
    all_v = np.vstack([[0, 0], v])
    d = all_x[1:] - all_x[:-1]
    w = all_v[1:] - all_v[:-1]
    rate = np.sum(d * w, axis=1) / np.linalg.norm(d, axis=1)
    return -np.sum(string.damping * rate ** 2)


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
