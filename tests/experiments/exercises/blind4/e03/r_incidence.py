"""Exercise 3: the forces on a string. Run me: python forces.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 3


def forces(x, v, string):
    """The force on every mass [N], shape (n, 2)."""
    n = len(x)
    z = x[:, 0] + 1j * x[:, 1]
    w = v[:, 0] + 1j * v[:, 1]
    B = np.eye(n) - np.eye(n, k=-1)  # spring i: mass i minus mass i-1
    d = B @ z
    d[0] -= complex(string.anchor[0], string.anchor[1])
    r = abs(d)
    t = -string.stiffness * (r - string.rest_lengths) * d / r
    total = B.T @ t - string.drag * w - 1j * string.gravity * string.masses
    return np.column_stack([total.real, total.imag])


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
