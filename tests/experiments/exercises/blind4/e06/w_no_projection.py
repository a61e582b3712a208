"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    T = 0.5 * sum(m * (w @ w) for m, w in zip(string.masses, v))
    U = 0.0
    for i, k in enumerate(string.stiffness):
        a = string.anchor if i == 0 else x[i - 1]
        U += 0.5 * k * (np.linalg.norm(x[i] - a) - string.rest_lengths[i]) ** 2
    V = sum(m * string.gravity * p[1] for m, p in zip(string.masses, x))
    return T, U, V


def power(x, v, string):
    """What damping adds to the energy [W]."""
    P = 0.0
    for i, c in enumerate(string.damping):
        rel = v[i] - v[i - 1] if i > 0 else v[i]
        P -= c * np.dot(rel, rel)
    for w in v:
        P -= string.drag * (w[0] ** 2 + w[1] ** 2)
    return P


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
