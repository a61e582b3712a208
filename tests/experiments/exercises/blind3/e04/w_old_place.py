"""Exercise 4: a string by Heun's step, the whole state at once. Run me: python whole_state.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 4


def accelerations(x, v, s):
    n = len(x)
    f = np.zeros((n, 2))
    for i in range(n):
        other = s.anchor if i == 0 else x[i - 1]
        d = x[i] - other
        r = np.sqrt(d @ d)
        t = -s.stiffness[i] * (r - s.rest_lengths[i]) * d / r
        f[i] += t
        if i > 0:
            f[i - 1] -= t
    f -= s.drag * v
    a = f / s.masses.reshape(n, 1)
    a[:, 1] -= s.gravity
    return a


def step(x, v, dt, string):
    a0 = accelerations(x, v, string)
    xe = x + v * dt
    ve = v + a0 * dt
    a1 = accelerations(x, ve, string)
    xn = x + (v + ve) * dt / 2
    vn = v + (a0 + a1) * dt / 2
    return xn, vn


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
