"""Exercise 3: the forces on a string. Run me: python forces.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 3


def forces(x, v, string):
    """The force on every mass [N], shape (n, 2)."""
    out = []
    for i in range(len(x)):
        fx, fy = 0.0, 0.0
        # neighbours: (where, spring)
        neighbours = [(x[i - 1] if i > 0 else string.anchor, i)]
        if i + 1 < len(x):
            neighbours.append((x[i + 1], i + 1))
        for p, s in neighbours:
            dx, dy = p[0] - x[i, 0], p[1] - x[i, 1]
            r = (dx * dx + dy * dy) ** 0.5
            q = string.stiffness[s] * (r - string.rest_lengths[s])
            fx += q * dx / r
            fy += q * dy / r
        fx -= string.masses[i] * string.gravity
        fx -= string.drag * v[i, 0]
        fy -= string.drag * v[i, 1]
        out.append([fx, fy])
    return np.array(out)


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
