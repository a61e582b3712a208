"""Exercise 4: a string by Heun's step, the whole state at once. Run me: python whole_state.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 4


def forces(x, v, string):
    nodes = np.vstack([string.anchor, x])
    seg = nodes[:-1] - nodes[1:]
    length = np.linalg.norm(seg, axis=1, keepdims=True)
    T = string.stiffness[:, None] * (length - string.rest_lengths[:, None]) * seg / length
    F = T.copy()
    F[:-1] -= T[1:]
    F[:, 1] -= string.masses * string.gravity
    return F - string.drag * v


def slopes(x, v, string):
    return v, forces(x, v, string)


def step(x, v, dt, string):
    """From positions x [m] and velocities v [m/s], shape (n, 2), those after dt [s]."""
    dx1, dv1 = slopes(x, v, string)
    dx2, dv2 = slopes(x + dt * dx1, v + dt * dv1, string)
    return x + dt * (dx1 + dx2) / 2, v + dt * (dv1 + dv2) / 2


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
