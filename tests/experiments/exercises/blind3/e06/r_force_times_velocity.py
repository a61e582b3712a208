"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def damping_forces(x, v, string):
    f = -string.drag * v
    for i in range(len(x)):
        if i == 0:
            e, u = x[0] - string.anchor, v[0]
        else:
            e, u = x[i] - x[i - 1], v[i] - v[i - 1]
        e = e / np.sqrt(e @ e)
        resist = string.damping[i] * np.outer(e, e) @ u
        f[i] -= resist
        if i > 0:
            f[i - 1] += resist
    return f


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    p = string.masses[:, None] * v
    above = np.r_[string.anchor[None], x[:-1]]
    stretch = np.sqrt(np.square(x - above).sum(axis=-1)) - string.rest_lengths
    return (
        np.vdot(p, v) / 2,
        np.dot(string.stiffness * stretch, stretch) / 2,
        string.gravity * np.dot(string.masses, x.T[1]),
    )


def power(x, v, string):
    """What damping adds to the energy [W]."""
    return np.vdot(damping_forces(x, v, string), v)


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
