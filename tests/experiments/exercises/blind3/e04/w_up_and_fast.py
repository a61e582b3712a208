"""Exercise 4: a string by Heun's step, the whole state at once. Run me: python whole_state.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 4


def accel(x, v, string):
    above = x.copy()
    above[1:] = x[:-1]
    above[0] = string.anchor
    d = above - x
    l = np.sqrt(np.sum(d * d, axis=1))
    pull = (string.stiffness * (l - string.rest_lengths))[:, None] * d / l[:, None]
    net = pull.copy()
    net[:-1] -= pull[1:]
    net -= string.drag * v
    net /= string.masses[:, None]
    net += [0.0, string.gravity]
    return net


def step(x, v, dt, string):
    """From positions x [m] and velocities v [m/s], shape (n, 2), those after dt [s]."""
    a = accel(x, v, string)
    xg = x + dt * v
    vg = v + dt * a
    b = accel(xg, vg, string)
    x1 = x + dt * (v + vg) / 2
    v1 = v + dt * (a + b)
    return x1, v1


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
