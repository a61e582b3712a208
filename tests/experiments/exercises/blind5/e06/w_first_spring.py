"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    n = x.shape[0]
    T = U = W = 0.0
    for i in range(n):
        T += string.masses[i] * (v[i, 0] ** 2 + v[i, 1] ** 2) / 2
        W += string.masses[i] * string.gravity * x[i, 1]
        a = x[i - 1] if i >= 1 else string.anchor
        l = np.sqrt((x[i, 0] - a[0]) ** 2 + (x[i, 1] - a[1]) ** 2)
        U += string.stiffness[i] * (l - string.rest_lengths[i]) ** 2 / 2
    return T, U, W


def power(x, v, string):
    """What damping adds to the energy [W]."""
    n = x.shape[0]
    p = 0.0
    for i in range(1, n):
        r = x[i] - x[i - 1]
        e = r / np.linalg.norm(r)
        rate = e @ (v[i] - v[i - 1])
        p -= string.damping[i] * rate ** 2
    for i in range(n):
        p -= string.drag * (v[i, 0] ** 2 + v[i, 1] ** 2)
    return p


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
