"""Exercise 3: the forces on a string. Run me: python forces.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 3


def forces(x, v, string):
    """The force on every mass [N], shape (n, 2)."""
    chain = np.vstack([string.anchor, x])
    f = np.zeros(chain.shape)
    for i, (k, L) in enumerate(zip(string.stiffness, string.rest_lengths)):
        d = chain[i + 1] - chain[i]
        l = np.sqrt(sum(d**2))
        F = k * (l - L) * d / l
        f[i] += F
        f[i + 1] -= F
    f = f[1:]  # nobody asks for the anchor
    f[:, 1] -= string.masses * string.gravity
    speed = np.linalg.norm(v, axis=1, keepdims=True)
    return f - string.drag * speed * v


if __name__ == "__main__":
    string = SimpleNamespace(
        masses=np.full(3, 0.05),
        stiffness=np.full(3, 50.0),
        rest_lengths=np.full(3, 0.15),
        drag=0.02,
        gravity=9.81,
        anchor=np.array([0.1, 0.2]),
    )
    x = string.anchor + np.array([[0.15, 0.0], [0.3, 0.0], [0.45, 0.0]])
    v = np.zeros((3, 2))
    print(forces(x, v, string))
