"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    n = len(x)
    kin = sum(0.5 * string.masses[i] * (v[i] @ v[i]) for i in range(n))
    pts = [string.anchor] + list(x)
    spr = sum(0.5 * string.stiffness[i] * (np.linalg.norm(pts[i + 1] - pts[i]) - string.rest_lengths[i]) ** 2 for i in range(n))
    pot = sum(string.masses[i] * string.gravity * x[i][1] for i in range(n))
    return kin, spr, pot


def power(x, v, string):
    """What damping adds to the energy [W]."""
    n = len(x)
    vel = [np.zeros(2)] + list(v)
    total = 0.0
    for i in range(n):
        rate = np.linalg.norm(vel[i + 1] - vel[i])
        total -= string.damping[i] * rate ** 2
    for i in range(n):
        total -= string.drag * (v[i] @ v[i])
    return total


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
