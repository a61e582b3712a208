"""Exercise 6: energy and damping, with the power as the sum of force times velocity. Run me: python energy.py."""

import math
from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def chain(x, v, string):
    """For each spring: its number, length, unit vector downwards along it and the rate of its length."""
    px, py = string.anchor
    pu = pw = 0.0
    for i in range(len(x)):
        dx, dy = x[i][0] - px, x[i][1] - py
        length = math.hypot(dx, dy)
        ex, ey = dx / length, dy / length
        yield i, length, (ex, ey), ex * (v[i][0] - pu) + ey * (v[i][1] - pw)
        px, py = x[i]
        pu, pw = v[i]


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    kinetic = sum(m * (u * u + w * w) / 2 for m, (u, w) in zip(string.masses, v))
    elastic = sum(string.stiffness[i] / 2 * (l - string.rest_lengths[i]) ** 2 for i, l, _, _ in chain(x, v, string))
    weight = sum(m * string.gravity * p[1] for m, p in zip(string.masses, x))
    return kinetic, elastic, weight


def power(x, v, string):
    """What damping adds to the energy [W]."""
    forces = [[-string.drag * u, -string.drag * w] for u, w in v]
    for i, _, (ex, ey), rate in chain(x, v, string):
        tension = string.damping[i] * rate
        forces[i][0] -= tension * ex
        forces[i][1] -= tension * ey
        if i:
            forces[i - 1][0] += tension * ex
            forces[i - 1][1] += tension * ey
    return sum(f[0] * u + f[1] * w for f, (u, w) in zip(forces, v))


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
