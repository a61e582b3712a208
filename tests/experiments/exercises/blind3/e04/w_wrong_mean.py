"""Exercise 4: a string by Heun's step, the whole state at once. Run me: python whole_state.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 4


def rates(x, v, string):
    up = np.concatenate([string.anchor[None], x[:-1]])
    e = up - x
    L = np.hypot(e[:, 0], e[:, 1])
    p = e * (string.stiffness * (1 - string.rest_lengths / L))[:, None]
    q = np.concatenate([p[1:], np.zeros((1, 2))])
    return (p - q - string.drag * v) / string.masses[:, None] - np.array([0, string.gravity])


def step(x, v, dt, string):
    """From positions x [m] and velocities v [m/s], shape (n, 2), those after dt [s]."""
    a1 = rates(x, v, string)
    a2 = rates(x + dt * v, v + dt * a1, string)
    v_new = v + dt * 0.5 * (a1 + a2)
    x_new = x + dt * 0.5 * (v + v_new)
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
