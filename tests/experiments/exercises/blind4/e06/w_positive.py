"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def _springs(x, v, string):
    p = np.vstack([string.anchor, x])
    u = np.vstack([np.zeros(2), v])
    d, du = p[1:] - p[:-1], u[1:] - u[:-1]
    l = np.linalg.norm(d, axis=1)
    return l, np.sum(d * du, axis=1) / l


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    l, _ = _springs(x, v, string)
    return (
        np.sum(string.masses[:, None] * v**2) / 2,
        np.sum(string.stiffness * (l - string.rest_lengths) ** 2) / 2,
        np.sum(string.masses * x[:, 1]) * string.gravity,
    )


def power(x, v, string):
    """What damping adds to the energy [W]."""
    _, rate = _springs(x, v, string)
    lost = np.sum(string.damping * rate**2) + string.drag * np.sum(v**2)
    return lost


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
