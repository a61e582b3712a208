"""Exercise 4: a string by Heun's step, the whole state at once. Run me: python whole_state.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 4


def get_forces(x, v, string):
    f = []
    n = len(x)
    for i in range(n):
        up = x[i - 1] if i else np.zeros(2)
        d = up - x[i]
        l = np.linalg.norm(d)
        s = string.stiffness[i] * (l - string.rest_lengths[i]) * d / l
        w = np.array([0.0, -string.masses[i] * string.gravity])
        f.append(s + w - string.drag * v[i])
        if i:
            f[i - 1] = f[i - 1] - s
    return np.array(f)


def step(x, v, dt, string):
    """From positions x [m] and velocities v [m/s], shape (n, 2), those after dt [s]."""
    M = string.masses[:, None]
    a1 = get_forces(x, v, string) / M
    xg, vg = x + dt * v, v + dt * a1
    a2 = get_forces(xg, vg, string) / M
    return x + dt * (v + vg) / 2, v + dt * (a1 - a2) / 2


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
