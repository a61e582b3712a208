"""Exercise 4: a string by Heun's step, the whole state at once. Run me: python whole_state.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 4


def acc(x, v, string):
    n = len(x)
    f = np.zeros((n, 2))
    for i in range(n):
        f[i] += [0, -string.masses[i] * string.gravity]
        f[i] -= string.drag * v[i]
        above = x[i - 1] if i > 0 else string.anchor
        d = above - x[i]
        l = np.linalg.norm(d)
        F = string.stiffness[i] * (l - string.rest_lengths[i]) * d / l
        f[i] += F
        if i > 0:
            f[i - 1] -= F
    return f / string.masses.reshape(n, 1)


def step(x, v, dt, string):
    """From positions x [m] and velocities v [m/s], shape (n, 2), those after dt [s]."""
    v1 = v.copy()
    a1 = acc(x, v, string)

    x_guess = x
    x_guess += dt * v1
    v_guess = v1 + dt * a1
    a2 = acc(x_guess, v_guess, string)

    x_new = x + dt * (v1 + v_guess) / 2
    v_new = v + dt * (a1 + a2) / 2
    return x_new, v_new


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
