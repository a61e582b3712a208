"""Exercise 4: a string by Heun's step, the whole state at once. Run me: python whole_state.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 4


def acceleration(x, v, string):
    n = len(x)
    a = np.empty((n, 2))
    below = np.zeros(2)  # what the spring below gives to the mass
    for i in reversed(range(n)):
        up = string.anchor if i == 0 else x[i - 1]
        r = up - x[i]
        l = np.linalg.norm(r)
        pull = string.stiffness[i] * (l - string.rest_lengths[i]) * (r / l)
        a[i] = (pull + below - string.drag * v[i]) / string.masses[i]
        a[i, 1] -= string.gravity
        below = -pull
    return a


def step(x, v, dt, string):
    """From positions x [m] and velocities v [m/s], shape (n, 2), those after dt [s]."""
    x1, v1 = x.copy(), v.copy()
    a0 = acceleration(x1, v1, string)
    x1 += dt * v
    v1 += dt * a0
    a1 = acceleration(x1, v1, string)
    x2 = x.copy()
    x2 += 0.5 * dt * v
    x2 += 0.5 * dt * v1
    v2 = v.copy()
    v2 += 0.5 * dt * a0
    v2 += 0.5 * dt * a1
    return x2, v2


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
