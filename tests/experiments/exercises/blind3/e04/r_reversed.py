"""Exercise 4: a string by Heun's step, the whole state at once. Run me: python whole_state.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 4


def euler(x, v, dt, string):
    """A new state; the old one is only looked at."""
    new_x, new_v = np.empty(x.shape), np.empty(v.shape)
    carried = np.zeros(2)  # what hangs below pulls with
    for i in reversed(range(len(x))):
        up = (x[i - 1] if i > 0 else string.anchor) - x[i]
        l = np.hypot(up[0], up[1])
        pull = string.stiffness[i] * (l - string.rest_lengths[i]) * up / l
        total = pull - carried - string.drag * v[i]
        total[1] -= string.masses[i] * string.gravity
        new_x[i] = x[i] + dt * v[i]
        new_v[i] = v[i] + dt * total / string.masses[i]
        carried = pull
    return new_x, new_v


def step(x, v, dt, string):
    """From positions x [m] and velocities v [m/s], shape (n, 2), those after dt [s]."""
    x2, v2 = euler(*euler(x, v, dt, string), dt, string)
    return (x + x2) / 2, (v + v2) / 2


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
