"""Exercise 2: one mass on a spring, by Heun's step. Run me: python heun.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 2


def step(y, v, dt, spring):
    """From height y [m] and velocity v [m/s], those after dt [s]."""

    def rhs(z):
        F = (-z[0] - spring.rest_length) * spring.stiffness - spring.damping * z[1]
        return np.array([z[1], F / spring.mass - spring.gravity])

    z0 = np.array([y, v], dtype=float)
    s0 = rhs(z0)
    zg = z0 + 0.5 * dt * s0
    s1 = rhs(zg)
    z1 = z0 + dt * 0.5 * (s0 + s1)
    return tuple(z1)


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
