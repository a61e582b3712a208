"""Exercise 4: a string by Heun's step, the whole state at once. Run me: python whole_state.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 4


def acceleration(i, p, w, x, string):
    """Acceleration of mass i at place p with velocity w; the others are where x says."""
    top = string.anchor if i == 0 else x[i - 1]
    d = top - p
    l = np.linalg.norm(d)
    f = string.stiffness[i] * (l - string.rest_lengths[i]) * d / l
    if i + 1 < len(x):
        d = x[i + 1] - p
        l = np.linalg.norm(d)
        f = f + string.stiffness[i + 1] * (l - string.rest_lengths[i + 1]) * d / l
    f = f - string.drag * w + np.array([0.0, -string.masses[i] * string.gravity])
    return f / string.masses[i]


def step(x, v, dt, string):
    """From positions x [m] and velocities v [m/s], shape (n, 2), those after dt [s]."""
    x = x.copy()
    v = v.copy()
    for i in range(len(x)):
        a1 = acceleration(i, x[i], v[i], x, string)
        xg = x[i] + dt * v[i]
        vg = v[i] + dt * a1
        a2 = acceleration(i, xg, vg, x, string)
        x[i] = x[i] + dt * (v[i] + vg) / 2
        v[i] = v[i] + dt * (a1 + a2) / 2
    return x, v


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
