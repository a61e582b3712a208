"""Exercise 4: a string by Heun's step, the whole state at once. Run me: python whole_state.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 4


def step(x, v, dt, string):
    """From positions x [m] and velocities v [m/s], shape (n, 2), those after dt [s]."""

    def slopes(x, v):
        a = np.zeros_like(x)
        for i in range(len(x)):
            m = string.masses[0]
            hold = x[i - 1] if i > 0 else string.anchor
            r = hold - x[i]
            l = np.hypot(r[0], r[1])
            f = string.stiffness[i] * (l - string.rest_lengths[i]) * r / l
            if i + 1 < len(x):
                r = x[i + 1] - x[i]
                l = np.hypot(r[0], r[1])
                f = f + string.stiffness[i + 1] * (l - string.rest_lengths[i + 1]) * r / l
            a[i] = (f - string.drag * v[i]) / m
            a[i][1] -= string.gravity
        return v, a

    dx1, dv1 = slopes(x, v)
    dx2, dv2 = slopes(x + dt * dx1, v + dt * dv1)
    return x + dt * 0.5 * (dx1 + dx2), v + dt * 0.5 * (dv1 + dv2)


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
