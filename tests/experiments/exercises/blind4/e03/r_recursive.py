"""Exercise 3: the forces on a string. Run me: python forces.py."""

from types import SimpleNamespace

import numpy as np
import math

EXERCISE = 3


def spring_force(p, q, k, rest):
    """Force on p by a spring between p and q."""
    dx, dy = q[0] - p[0], q[1] - p[1]
    length = math.sqrt(dx * dx + dy * dy)
    s = k * (1 - rest / length)
    return s * dx, s * dy


def forces(x, v, string):
    """The force on every mass [N], shape (n, 2)."""
    result = []
    n = len(x)
    for i in range(n):
        holder = x[i - 1] if i > 0 else string.anchor
        fx, fy = spring_force(x[i], holder, string.stiffness[i], string.rest_lengths[i])
        if i + 1 < n:
            gx, gy = spring_force(x[i], x[i + 1], string.stiffness[i + 1], string.rest_lengths[i + 1])
            fx += gx
            fy += gy
        fx -= string.drag * v[i][0]
        fy -= string.drag * v[i][1] + string.masses[i] * string.gravity
        result.append([fx, fy])
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
