"""Exercise 4: a string by Heun's step, the whole state at once. Run me: python whole_state.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 4


def accelerate(x, v, string):
    G = np.array([0.0, string.gravity])
    a = np.zeros_like(x)
    for i in range(len(x)):
        neighbours = [(string.anchor if i == 0 else x[i - 1], i)]
        if i + 1 < len(x):
            neighbours.append((x[i + 1], i + 1))
        force = string.masses[i] * G - string.drag * v[i]
        for other, s in neighbours:
            d = other - x[i]
            l = (d ** 2).sum() ** 0.5
            force = force + d / l * string.stiffness[s] * (l - string.rest_lengths[s])
        a[i] = force / string.masses[i]
    return a


def step(x, v, dt, string):
    """From positions x [m] and velocities v [m/s], shape (n, 2), those after dt [s]."""
    a_0 = accelerate(x, v, string)
    x_1 = x + dt * v
    v_1 = v + dt * a_0
    a_1 = accelerate(x_1, v_1, string)
    x_2 = x + dt * (v + v_1)
    v_2 = v + 0.5 * dt * (a_0 + a_1)
    return x_2, v_2


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
