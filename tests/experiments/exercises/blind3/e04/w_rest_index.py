"""Exercise 4: a string by Heun's step, the whole state at once. Run me: python whole_state.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 4


def one_spring(a, b, k, rest):
    d = b - a
    dist = np.linalg.norm(d)
    return k * (dist - rest) * (d / dist)


def slope(x, v, string):
    n = x.shape[0]
    dv = np.empty_like(v)
    for i in range(n):
        if i == 0:
            f = one_spring(x[0], string.anchor, string.stiffness[0], string.rest_lengths[0])
        else:
            f = one_spring(x[i], x[i - 1], string.stiffness[i], string.rest_lengths[i])
        if i != n - 1:
            f = f + one_spring(x[i], x[i + 1], string.stiffness[i + 1], string.rest_lengths[i])
        f = f - string.drag * v[i]
        dv[i] = f / string.masses[i]
        dv[i][1] -= string.gravity
    return v.copy(), dv


def step(x, v, dt, string):
    """From positions x [m] and velocities v [m/s], shape (n, 2), those after dt [s]."""
    sx, sv = slope(x, v, string)
    gx = x + dt * sx
    gv = v + dt * sv
    tx, tv = slope(gx, gv, string)
    return x + 0.5 * dt * (sx + tx), v + 0.5 * dt * (sv + tv)


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
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   the last mass is at {x[-1]} m")
        x, v = step(x, v, 0.005, string)
