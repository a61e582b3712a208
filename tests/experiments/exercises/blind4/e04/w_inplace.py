"""Exercise 4: a string by Heun's step, the whole state at once. Run me: python whole_state.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 4


def forces(x, v, string):
    d = np.diff(np.vstack([string.anchor, x]), axis=0)
    l = np.linalg.norm(d, axis=1, keepdims=True)
    T = string.stiffness[:, None] * (l - string.rest_lengths[:, None]) * d / l
    F = -T
    F[:-1] += T[1:]
    F[:, 1] -= string.masses * string.gravity
    return F - string.drag * v


def step(x, v, dt, string):
    """From positions x [m] and velocities v [m/s], shape (n, 2), those after dt [s]."""
    m = string.masses.reshape(-1, 1)
    a1 = forces(x, v, string) / m
    xg = x + dt * v
    vg = v + dt * a1
    a2 = forces(xg, vg, string) / m
    x += dt / 2 * (v + vg)
    v += dt / 2 * (a1 + a2)
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
