"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    M = np.diag(string.masses)
    n = len(x)
    D = np.eye(n) - np.eye(n, k=-1)
    d = D @ x - np.outer(np.arange(n) == 0, string.anchor)
    s = np.linalg.norm(d, axis=1) - string.rest_lengths
    return np.trace(v.T @ M @ v) / 2, s @ np.diag(string.stiffness) @ s / 2, string.gravity * np.trace(M * x[:, 1])


def power(x, v, string):
    """What damping adds to the energy [W]."""
    n = len(x)
    C = string.drag * np.eye(2 * n)
    for i in range(n):
        B = np.zeros((1, 2 * n))
        d = x[i] - (x[i - 1] if i else string.anchor)
        B[0, 2 * i : 2 * i + 2] = d / np.linalg.norm(d)
        if i:
            B[0, 2 * i - 2 : 2 * i] = -B[0, 2 * i : 2 * i + 2]
        C += string.damping[i] * B.T @ B
    w = v.reshape(-1)
    return -(w @ C @ w)


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
