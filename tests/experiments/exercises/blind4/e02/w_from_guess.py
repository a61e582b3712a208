"""Exercise 2: one mass on a spring, by Heun's step. Run me: python heun.py."""

from types import SimpleNamespace

EXERCISE = 2


import numpy as np


def f(s, p):
    y, v = s
    F = p.stiffness * (-y - p.rest_length) - p.damping * v - p.mass * p.gravity
    return np.array([v, F / p.mass])


def step(y, v, dt, spring):
    """From height y [m] and velocity v [m/s], those after dt [s]."""
    s = np.array([y, v])
    k1 = f(s, spring)
    s = s + dt * k1
    k2 = f(s, spring)
    s = s + dt / 2 * (k1 + k2)
    return s[0], s[1]


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
