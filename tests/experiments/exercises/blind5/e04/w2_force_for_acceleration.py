"""Exercise 4: a string by Heun's step, the whole state at once. Run me: python whole_state.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 4


def F(x, v, string):
    shifted = np.roll(x, 1, axis=0)
    shifted[0] = string.anchor
    d = shifted - x
    l = np.linalg.norm(d, axis=1)
    f = (string.stiffness * (l - string.rest_lengths) / l)[:, None] * d
    f = f - string.drag * v
    f[:, 1] = f[:, 1] - string.masses * string.gravity
    return f


def step(x, v, dt, string):
    """From positions x [m] and velocities v [m/s], shape (n, 2), those after dt [s]."""
    k1x, k1v = v, F(x, v, string)
    k2x, k2v = v + dt * k1v, F(x + dt * k1x, v + dt * k1v, string)
    return x + dt * (k1x + k2x) / 2, v + dt * (k1v + k2v) / 2


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
