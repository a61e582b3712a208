"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    kinetic = np.sum(string.masses * np.linalg.norm(v, axis=1) ** 2)
    pts = np.vstack([string.anchor, x])
    ext = np.linalg.norm(pts[1:] - pts[:-1], axis=1) - string.rest_lengths
    elastic = np.sum(string.stiffness * ext**2) * 0.5
    weight = np.sum(string.masses * x[:, 1] * string.gravity)
    return kinetic, elastic, weight


def power(x, v, string):
    """What damping adds to the energy [W]."""
    pts = np.vstack([string.anchor, x])
    vel = np.vstack([[0, 0], v])
    d = pts[1:] - pts[:-1]
    n = d / np.linalg.norm(d, axis=1)[:, None]
    rel = np.sum((vel[1:] - vel[:-1]) * n, axis=1)
    by_springs = np.sum(string.damping * rel**2)
    by_drag = np.sum(string.drag * v**2)
    return by_springs + by_drag


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
