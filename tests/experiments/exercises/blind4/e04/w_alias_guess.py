"""Exercise 4: a string by Heun's step, the whole state at once. Run me: python whole_state.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 4


def acc(x, v, s):
    n = len(x)
    f = np.zeros((n, 2))
    for i in range(n):
        r = x[i] - (x[i - 1] if i else s.anchor)
        l = np.linalg.norm(r)
        t = s.stiffness[i] * (l - s.rest_lengths[i]) * r / l
        f[i] -= t + s.drag * v[i]
        f[i, 1] -= s.masses[i] * s.gravity
        if i:
            f[i - 1] += t
    return f / s.masses[:, None]


def step(x, v, dt, string):
    """From positions x [m] and velocities v [m/s], shape (n, 2), those after dt [s]."""
    x, v = x.copy(), v.copy()  # leave theirs alone
    a = acc(x, v, string)
    xg = x
    xg += dt * v
    vg = v + dt * a
    ag = acc(xg, vg, string)
    return x + 0.5 * dt * (v + vg), v + 0.5 * dt * (a + ag)


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
