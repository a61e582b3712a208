"""Exercise 3: the forces on a string. Run me: python forces.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 3


def forces(x, v, string):
    """The force on every mass [N], shape (n, 2)."""
    z = [complex(*p) for p in x]
    w = [complex(*p) for p in v]
    chain = [complex(*string.anchor)] + z
    pulls = []
    for a, b, k, rest in zip(chain, z, string.stiffness, string.rest_lengths):
        pulls.append(k * (abs(a - b) - rest) * (a - b) / abs(a - b))
    pulls.append(0j)  # nothing hangs on the last
    total = [
        pulls[i] - pulls[i + 1] - 1j * m * string.gravity - string.drag * w[i] for i, m in enumerate(string.masses)
    ]
    return np.array([[t.real, t.imag] for t in total])


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
