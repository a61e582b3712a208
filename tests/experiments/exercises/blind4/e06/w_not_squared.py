"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    ke = 0.5 * np.dot(string.masses, np.sum(v * v, axis=1))
    above = np.roll(x, 1, axis=0)
    above[0] = string.anchor
    ext = np.linalg.norm(x - above, axis=1) - string.rest_lengths
    pe = 0.5 * np.dot(string.stiffness, ext**2)
    ge = np.dot(string.masses * string.gravity, x[:, 1])
    return ke, pe, ge


def power(x, v, string):
    """What damping adds to the energy [W]."""
    above, v_above = np.roll(x, 1, axis=0), np.roll(v, 1, axis=0)
    above[0], v_above[0] = string.anchor, 0
    e = (x - above) / np.linalg.norm(x - above, axis=1, keepdims=True)
    rate = np.sum((v - v_above) * e, axis=1)
    p_springs = -np.dot(string.damping, np.abs(rate))
    p_drag = -string.drag * np.sum(v * v)
    return p_springs + p_drag


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
