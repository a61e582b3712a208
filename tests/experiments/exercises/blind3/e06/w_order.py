"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    m = string.masses
    kinetic = 0.5 * m @ (v[:, 0] ** 2 + v[:, 1] ** 2)
    potential = string.gravity * m @ x[:, 1]
    joints = np.vstack([string.anchor[None, :], x])
    stretch = np.linalg.norm(joints[1:] - joints[:-1], axis=1) - string.rest_lengths
    spring = 0.5 * string.stiffness @ stretch**2
    return kinetic, potential, spring


def power(x, v, string):
    """What damping adds to the energy [W]."""
    joints = np.vstack([string.anchor[None, :], x])
    vel = np.vstack([np.zeros((1, 2)), v])
    d = joints[1:] - joints[:-1]
    u = d / np.linalg.norm(d, axis=1)[:, None]
    closing = np.sum(u * (vel[1:] - vel[:-1]), axis=1)
    lost = string.damping @ closing**2 + string.drag * np.sum(v * v)
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
