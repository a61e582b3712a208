"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    speed = np.hypot(v[:, 0], v[:, 1])
    kin = (string.masses * speed ** 2 / 2).sum()

    ends = np.append([string.anchor], x, axis=0)
    d = ends[1:] - ends[:-1]
    stretch = np.hypot(d[:, 0], d[:, 1]) - string.rest_lengths
    ela = (string.stiffness * stretch ** 2 / 2).sum()

    h = x[:, 0]
    pot = (string.masses * string.gravity * h).sum()
    return kin, ela, pot


def power(x, v, string):
    """What damping adds to the energy [W]."""
    ends = np.append([string.anchor], x, axis=0)
    speeds = np.append([[0.0, 0.0]], v, axis=0)
    d, w = np.diff(ends, axis=0), np.diff(speeds, axis=0)
    unit = d / np.hypot(d[:, 0], d[:, 1])[:, None]
    rate = (unit * w).sum(axis=1)
    lost = (string.damping * rate ** 2).sum() + string.drag * (v ** 2).sum()
    return -lost


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
