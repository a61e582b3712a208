"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def length(i, x, string):
    d = x[i] - string.anchor if i == 0 else x[i] - x[i - 1]
    return np.hypot(d[0], d[1])


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    n = len(x)
    K = sum(0.5 * string.masses[i] * (v[i] ** 2).sum() for i in range(n))
    S = sum(0.5 * string.stiffness[i] * (length(i, x, string) - string.rest_lengths[i]) ** 2 for i in range(n))
    W = sum(string.masses[i] * string.gravity * x[i, 1] for i in range(n))
    return K, S, W


def power(x, v, string):
    """What damping adds to the energy [W]."""
    total = 0
    for i in range(1, len(x)):
        rate = np.dot(x[i] - x[i - 1], v[i] - v[i - 1]) / length(i, x, string)
        total -= string.damping[i] * rate**2
    for i in range(len(x)):
        total -= string.drag * np.dot(v[i], v[i])
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
