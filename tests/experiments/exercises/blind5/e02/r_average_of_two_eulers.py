"""Exercise 2. Heun is also: the mean of the start and of two Euler steps in a row."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 2


def euler(s, dt, p):
    a = -(p.stiffness * (s[0] + p.rest_length) + p.damping * s[1]) / p.mass - p.gravity
    return s + dt * np.array([s[1], a])


def step(y, v, dt, spring):
    start = np.array([y, v], dtype=float)
    twice = euler(euler(start, dt, spring), dt, spring)
    # start + dt/2 (k1 + k2) = (start + [start + dt k1 + dt k2]) / 2
    end = 0.5 * (start + twice)
    return end[0], end[1]


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
