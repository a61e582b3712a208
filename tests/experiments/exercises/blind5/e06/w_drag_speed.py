"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    kinetic = 0.5 * (string.masses @ (v * v)).sum()
    shifted = np.roll(x, 1, axis=0)
    shifted[0] = string.anchor
    extension = np.linalg.norm(x - shifted, axis=1) - string.rest_lengths
    return kinetic, 0.5 * (string.stiffness * extension) @ extension, string.masses @ x[:, 1] * string.gravity


def power(x, v, string):
    """What damping adds to the energy [W]."""
    shifted, shifted_v = np.roll(x, 1, axis=0), np.roll(v, 1, axis=0)
    shifted[0] = string.anchor
    shifted_v[0] = 0.0
    link = x - shifted
    link /= np.linalg.norm(link, axis=1, keepdims=True)
    rate = np.sum(link * (v - shifted_v), axis=1)
    spring_power = -string.damping @ (rate * rate)
    drag_power = -string.drag * np.linalg.norm(v, axis=1).sum()
    return spring_power + drag_power


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
