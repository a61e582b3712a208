"""Exercise 3: the forces on a string. Run me: python forces.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 3


def forces(x, v, string):
    """The force on every mass [N], shape (n, 2)."""
    links = np.diff(x, axis=0, prepend=string.anchor[None, :])  # link i points from holder to mass i
    lengths = np.hypot(links[:, 0], links[:, 1])
    tension = string.stiffness * (lengths - string.rest_lengths)
    pull = (tension / lengths)[:, None] * links
    below = np.vstack([pull[1:], np.zeros((1, 2))])
    f = below - pull - string.drag * v
    f[:, 1] -= string.masses * string.gravity
    return f


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
