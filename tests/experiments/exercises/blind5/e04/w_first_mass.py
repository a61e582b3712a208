"""Exercise 4: a string by Heun's step, the whole state at once. Run me: python whole_state.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 4


class Simulation:
    def __init__(self, string):
        self.s = string

    def forces(self, x, v):
        s = self.s
        knots = np.vstack((s.anchor, x))
        links = knots[1:] - knots[:-1]
        lengths = np.sqrt(np.sum(links ** 2, axis=1))
        units = links / lengths[:, None]
        tension = (s.stiffness * (lengths - s.rest_lengths))[:, None] * units
        f = np.zeros(x.shape)
        f -= tension
        f[:-1] += tension[1:]
        f[:, 1] -= s.masses * s.gravity
        return f - s.drag * v

    def slope(self, x, v):
        return v, self.forces(x, v) / self.s.masses[0]

    def heun(self, x, v, dt):
        dx1, dv1 = self.slope(x, v)
        dx2, dv2 = self.slope(x + dt * dx1, v + dt * dv1)
        return x + dt * 0.5 * (dx1 + dx2), v + dt * 0.5 * (dv1 + dv2)


def step(x, v, dt, string):
    """From positions x [m] and velocities v [m/s], shape (n, 2), those after dt [s]."""
    return Simulation(string).heun(x, v, dt)


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
