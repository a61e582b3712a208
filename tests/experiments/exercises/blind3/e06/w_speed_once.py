"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def chain(first, rest):
    return np.vstack((first, rest))


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    speed = np.hypot(v[:, 0], v[:, 1])
    ext = np.linalg.norm(np.diff(chain(string.anchor, x), axis=0), axis=1) - string.rest_lengths
    return (
        (string.masses * speed**2).sum() / 2,
        (string.stiffness * ext**2).sum() / 2,
        string.gravity * (string.masses @ x[:, 1]),
    )


def power(x, v, string):
    """What damping adds to the energy [W]."""
    speed = np.hypot(v[:, 0], v[:, 1])
    d = np.diff(chain(string.anchor, x), axis=0)
    u = d / np.linalg.norm(d, axis=1, keepdims=True)
    w = np.diff(chain([0.0, 0.0], v), axis=0)
    rate = np.einsum("ij,ij->i", u, w)
    return -(string.damping @ rate**2) - (string.drag * speed).sum()


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
