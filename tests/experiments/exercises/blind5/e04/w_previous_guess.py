"""Exercise 4: a string by Heun's step, the whole state at once. Run me: python whole_state.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 4


def one_force(i, x, v, string):
    up = x[i - 1] if i else string.anchor
    e = up - x[i]
    l = np.hypot(e[0], e[1])
    f = string.stiffness[i] * (l - string.rest_lengths[i]) * e / l - string.drag * v[i]
    f[1] -= string.masses[i] * string.gravity
    if i < len(x) - 1:
        e = x[i + 1] - x[i]
        l = np.hypot(e[0], e[1])
        f += string.stiffness[i + 1] * (l - string.rest_lengths[i + 1]) * e / l
    return f


def step(x, v, dt, string):
    """From positions x [m] and velocities v [m/s], shape (n, 2), those after dt [s]."""
    n = len(x)
    xg, vg = x.copy(), v.copy()
    a1, a2 = np.zeros((n, 2)), np.zeros((n, 2))
    for i in range(n):
        a1[i] = one_force(i, xg, vg, string) / string.masses[i]
        xg[i] += dt * v[i]
        vg[i] += dt * a1[i]
    for i in range(n):
        a2[i] = one_force(i, xg, vg, string) / string.masses[i]
    return x + dt / 2 * (v + vg), v + dt / 2 * (a1 + a2)


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
