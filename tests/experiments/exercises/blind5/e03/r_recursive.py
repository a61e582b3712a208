"""Exercise 3, link by link from the anchor down: each call knows what holds its mass and asks the next for its pull."""

from math import dist
from types import SimpleNamespace

import numpy as np

EXERCISE = 3


def forces(x, v, string):
    out = [None] * len(x)

    def pull(i, above):
        """What spring i exerts on whatever is above it; fills in all masses from i on."""
        if i == len(x):
            return 0.0, 0.0
        here = x[i]
        length = dist(here, above)
        factor = string.stiffness[i] * (1 - string.rest_lengths[i] / length)
        px, py = factor * (here[0] - above[0]), factor * (here[1] - above[1])
        below_x, below_y = pull(i + 1, here)
        out[i] = [
            below_x - px - string.drag * v[i][0],
            below_y - py - string.drag * v[i][1] - string.masses[i] * string.gravity,
        ]
        return px, py

    pull(0, string.anchor)
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
