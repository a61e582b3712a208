"""Exercise 4: a string by Heun's step, the whole state at once. Run me: python whole_state.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 4


def force(x, v, string):
    F = np.zeros_like(x)
    last = string.anchor
    for i, pos in enumerate(x):
        d = last - pos
        ell = np.linalg.norm(d)
        S = string.stiffness[i] * (ell - string.rest_lengths[i]) / ell * d
        F[i] += S
        if i >= 1:
            F[i - 1] -= S
        F[i] -= string.drag * v[i]
        F[i, 1] -= string.masses[i] * string.gravity
        last = pos
    return F


def step(x, v, dt, string):
    """From positions x [m] and velocities v [m/s], shape (n, 2), those after dt [s]."""
    m = string.masses[:, np.newaxis]
    a = force(x, v, string) / m
    xp = x + dt * v
    vp = v + a
    ap = force(xp, vp, string) / m
    return x + 0.5 * dt * (v + vp), v + 0.5 * dt * (a + ap)


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
