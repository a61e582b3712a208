"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    n = len(x)
    ke = 0
    se = 0
    pe = 0
    p = string.anchor
    for i in range(n):
        vx, vy = v[i]
        ke += string.masses[i] * (vx**2 + vy**2) / 2
        l = np.sqrt((x[i][0] - p[0]) ** 2 + (x[i][1] - p[1]) ** 2)
        se += string.stiffness[i] * (l - string.rest_lengths[i]) ** 2 / 2
        pe += string.masses[i] * string.gravity * (x[i][1] - string.anchor[1])
        p = x[i]
    return ke, se, pe


def power(x, v, string):
    """What damping adds to the energy [W]."""
    result = 0
    p = string.anchor
    vp = np.zeros(2)
    for i in range(len(x)):
        d = x[i] - p
        direction = d / np.linalg.norm(d)
        rate = np.dot(v[i] - vp, direction)
        result -= string.damping[i] * rate**2
        result -= string.drag * np.dot(v[i], v[i])
        p, vp = x[i], v[i]
    return result


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
