"""Exercise 4: a string by Heun's step, the whole state at once. Run me: python whole_state.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 4


def acceleration(pos, vel, string):
    ends = np.insert(pos, 0, string.anchor, axis=0)
    d = ends[:-1] - ends[1:]
    l = np.linalg.norm(d, axis=1)
    pull = d * (string.stiffness * (l - string.rest_lengths) / l)[:, None]
    push = np.append(pull[1:], [[0.0, 0.0]], axis=0)
    g = np.array([0.0, -string.gravity])
    return (pull - push - string.drag * vel) / string.masses[:, None] + g


def step(x, v, dt, string):
    """From positions x [m] and velocities v [m/s], shape (n, 2), those after dt [s]."""
    a_now = acceleration(x, v, string)
    x_guess = x + v * dt
    v_guess = v + a_now * dt
    a_then = acceleration(x, v_guess, string)
    v_mean = (v + v_guess) / 2
    a_mean = (a_now + a_then) / 2
    return x + v_mean * dt, v + a_mean * dt


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
