"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    kinetic = 0.5 * np.einsum("i,ij,ij->", string.masses, v, v)
    links = np.diff(x, axis=0, prepend=string.anchor[None, :])
    elastic = 0.5 * string.stiffness @ (np.linalg.norm(links, axis=1) - string.rest_lengths) ** 2
    weight = string.gravity * string.masses @ x[:, 1]
    return kinetic, elastic, weight


def power(x, v, string):
    """What damping adds to the energy [W]."""
    links = np.diff(x, axis=0, prepend=string.anchor[None, :])
    turning = np.diff(v, axis=0, prepend=np.zeros((1, 2)))
    rate = np.einsum("ij,ij->i", links, turning) / np.linalg.norm(links, axis=1)
    return -(string.damping @ rate**2) - string.drag * np.vdot(v, v)


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
