"""Exercise 4: a string by Heun's step, the whole state at once. Run me: python whole_state.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 4


def forces(x, v, string):
    top = np.vstack((string.anchor, x[:-1]))
    r = top - x
    dist = np.sqrt(np.sum(r * r, axis=1))
    f = (string.stiffness * (1 - string.rest_lengths / dist))[:, None] * r
    out = f - string.drag * v
    out[:-1] -= f[1:]
    out[:, 1] -= string.masses * string.gravity
    return out


def step(x, v, dt, string):
    """From positions x [m] and velocities v [m/s], shape (n, 2), those after dt [s]."""
    inv_m = 1 / string.masses[:, None]
    k1x = v
    k1v = inv_m * forces(x, v, string)
    k2x = v + dt * k1v
    k2v = forces(x + dt * k1x, k2x, string)
    x_new = x + dt / 2 * (k1x + k2x)
    v_new = v + dt / 2 * (k1v + k2v)
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
