"""Exercise 4: a string by Heun's step, the whole state at once. Run me: python whole_state.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 4


def acc(i, x, v, s):
    """Acceleration of mass i."""
    up = s.anchor if i == 0 else x[i - 1]
    d = up - x[i]
    l = np.linalg.norm(d)
    F = s.stiffness[i] * (l - s.rest_lengths[i]) * d / l
    if i + 1 < len(x):
        d = x[i + 1] - x[i]
        l = np.linalg.norm(d)
        F = F + s.stiffness[i + 1] * (l - s.rest_lengths[i + 1]) * d / l
    F = F - s.drag * v[i]
    return F / s.masses[i] + np.array([0.0, -s.gravity])


def step(x, v, dt, string):
    """From positions x [m] and velocities v [m/s], shape (n, 2), those after dt [s]."""
    x = x.copy()
    v = v.copy()
    n = len(x)
    k1x = v.copy()
    k1v = np.array([acc(i, x, v, string) for i in range(n)])
    xg = x + dt * k1x
    vg = v + dt * k1v
    for i in range(n):
        k2x = vg[i].copy()
        k2v = acc(i, xg, vg, string)
        xg[i] = x[i] + dt * (k1x[i] + k2x) / 2
        vg[i] = v[i] + dt * (k1v[i] + k2v) / 2
    return xg, vg


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
