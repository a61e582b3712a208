"""Exercise 3: the forces on a string. Run me: python forces.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 3


def forces(x, v, string):
    """The force on every mass [N], shape (n, 2)."""
    links = np.diff(np.vstack([string.anchor, x]), axis=0)
    lengths = np.hypot(links[:, 0], links[:, 1])
    tension = string.stiffness * (lengths - string.rest_lengths)
    pulls = (tension / lengths)[:, None] * links
    weight = np.outer(string.masses, [0.0, -string.gravity])
    return weight - string.drag * v - pulls + np.vstack([pulls[1:], np.zeros((1, 2))])


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
