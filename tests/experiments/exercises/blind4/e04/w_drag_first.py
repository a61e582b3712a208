"""Exercise 4: a string by Heun's step, the whole state at once. Run me: python whole_state.py."""

from types import SimpleNamespace

import numpy as np
from dataclasses import dataclass

EXERCISE = 4


@dataclass
class State:
    x: np.ndarray
    v: np.ndarray

    def moved(self, dx, dv, h):
        return State(self.x + h * dx, self.v + h * dv)


def derivative(st, s):
    d = st.x - np.vstack([s.anchor, st.x[:-1]])
    l = np.linalg.norm(d, axis=1)
    t = s.stiffness * (l - s.rest_lengths)
    e = d / l[:, None]
    f = -t[:, None] * e
    f[:-1] += t[1:, None] * e[1:]
    a = f / s.masses[:, None]
    a[:, 1] -= s.gravity
    a -= s.drag * st.v
    return st.v, a


def step(x, v, dt, string):
    """From positions x [m] and velocities v [m/s], shape (n, 2), those after dt [s]."""
    st = State(x, v)
    d1 = derivative(st, string)
    d2 = derivative(st.moved(*d1, dt), string)
    end = st.moved((d1[0] + d2[0]) / 2, (d1[1] + d2[1]) / 2, dt)
    return end.x, end.v


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
