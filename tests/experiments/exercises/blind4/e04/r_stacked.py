"""Exercise 4: a string by Heun's step, the whole state at once. Run me: python whole_state.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 4


def slope(state, s):
    x, v = state
    d = np.diff(np.vstack([s.anchor, x]), axis=0)
    l = np.linalg.norm(d, axis=1)
    t = (s.stiffness * (l - s.rest_lengths) / l)[:, None] * d
    f = -t - s.drag * v
    f[:-1] += t[1:]
    f[:, 1] -= s.masses * s.gravity
    return np.array([v, f / s.masses[:, None]])


def step(x, v, dt, string):
    """From positions x [m] and velocities v [m/s], shape (n, 2), those after dt [s]."""
    now = np.array([x, v])
    k1 = slope(now, string)
    k2 = slope(now + dt * k1, string)
    after = now + dt * (k1 + k2) / 2
    return after[0], after[1]


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
