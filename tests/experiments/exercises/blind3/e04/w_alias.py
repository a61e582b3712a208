"""Exercise 4: a string by Heun's step, the whole state at once. Run me: python whole_state.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 4


def acceleration(x, v, string):
    above = np.vstack([string.anchor, x[:-1]])
    d = above - x
    l = np.linalg.norm(d, axis=1)
    pull = (string.stiffness * (l - string.rest_lengths) / l)[:, None] * d
    f = pull - string.drag * v
    f[:-1] -= pull[1:]
    a = f / string.masses[:, None]
    a[:, 1] -= string.gravity
    return a


def step(x, v, dt, string):
    """From positions x [m] and velocities v [m/s], shape (n, 2), those after dt [s]."""
    a1 = acceleration(x, v, string)
    x_guess = x
    x_guess += dt * v
    v_guess = v + dt * a1
    a2 = acceleration(x_guess, v_guess, string)
    x_new = x + dt / 2 * (v + v_guess)
    v_new = v + dt / 2 * (a1 + a2)
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
