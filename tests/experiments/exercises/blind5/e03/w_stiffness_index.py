"""Exercise 3: the forces on a string. Run me: python forces.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 3


def length(p, q):
    return ((p[0] - q[0]) ** 2 + (p[1] - q[1]) ** 2) ** 0.5


def forces(x, v, string):
    """The force on every mass [N], shape (n, 2)."""
    n = x.shape[0]
    result = []
    for i in range(n):
        fx = -string.drag * v[i, 0]
        fy = -string.drag * v[i, 1] - string.masses[i] * string.gravity

        # spring above
        top = x[i - 1] if i > 0 else string.anchor
        l = length(top, x[i])
        t = string.stiffness[i] * (l - string.rest_lengths[i])
        fx += t * (top[0] - x[i, 0]) / l
        fy += t * (top[1] - x[i, 1]) / l

        # spring below
        if i < n - 1:
            bottom = x[i + 1]
            l = length(bottom, x[i])
            t = string.stiffness[i] * (l - string.rest_lengths[i + 1])
            fx += t * (bottom[0] - x[i, 0]) / l
            fy += t * (bottom[1] - x[i, 1]) / l
        result.append((fx, fy))
    return np.array(result)


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
