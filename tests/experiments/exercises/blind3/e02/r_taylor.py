"""Exercise 2: one mass on a spring, by Heun's step. Run me: python heun.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 2


def step(y, v, dt, spring):
    """From height y [m] and velocity v [m/s], those after dt [s]."""
    # z' = A z with z = (y, v, 1); Heun of a linear system is the series to second order
    A = np.zeros((3, 3))
    A[0, 1] = 1
    A[1] = [-spring.stiffness, -spring.damping, -spring.stiffness * spring.rest_length]
    A[1] /= spring.mass
    A[1, 2] -= spring.gravity
    h = dt * A
    z = np.array([y, v, 1.0])
    z = z + h @ z + h @ (h @ z) / 2
    return z[0], z[1]


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
