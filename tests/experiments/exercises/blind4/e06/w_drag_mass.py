"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    kin, spr, pot = 0.0, 0.0, 0.0
    previous = string.anchor
    for m, k, l0, pos, vel in zip(string.masses, string.stiffness, string.rest_lengths, x, v):
        kin += m * np.dot(vel, vel) / 2
        pot += m * string.gravity * pos[1]
        spr += k * (np.linalg.norm(pos - previous) - l0) ** 2 / 2
        previous = pos
    return kin, spr, pot


def power(x, v, string):
    """What damping adds to the energy [W]."""
    watts = 0.0
    before, vbefore = string.anchor, np.zeros(2)
    for m, c, pos, vel in zip(string.masses, string.damping, x, v):
        axis = (pos - before) / np.linalg.norm(pos - before)
        watts -= c * np.dot(axis, vel - vbefore) ** 2
        watts -= string.drag * m * np.dot(vel, vel)
        before, vbefore = pos, vel
    return watts


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
