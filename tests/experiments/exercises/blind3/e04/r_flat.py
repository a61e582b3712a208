"""Exercise 4: a string by Heun's step, the whole state at once. Run me: python whole_state.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 4


def heun(f, z, h):
    k1 = f(z)
    k2 = f(z + h * k1)
    return z + h / 2 * (k1 + k2)


def step(x, v, dt, string):
    """From positions x [m] and velocities v [m/s], shape (n, 2), those after dt [s]."""
    n = len(x)

    def f(z):
        p, w = z[: 2 * n].reshape(n, 2), z[2 * n :].reshape(n, 2)
        gap = p - np.vstack((string.anchor, p))[:n]
        size = np.linalg.norm(gap, axis=1)
        t = (string.stiffness * (size - string.rest_lengths) / size)[:, None] * gap
        net = np.vstack((t[1:], np.zeros(2))) - t - string.drag * w
        acc = net / string.masses[:, None] - np.array([0, string.gravity])
        return np.concatenate((w.ravel(), acc.ravel()))

    z = heun(f, np.concatenate((x.ravel(), v.ravel())), dt)
    return z[: 2 * n].reshape(n, 2), z[2 * n :].reshape(n, 2)


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
