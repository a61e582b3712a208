"""Exercise 1 as a matrix: s' = A s + b, so one Euler step is s + dt (A s + b)."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 1


def step(y, v, dt, spring):
    k_m = spring.stiffness / spring.mass
    c_m = spring.damping / spring.mass
    A = np.array([[0.0, 1.0], [-k_m, -c_m]])
    b = np.array([0.0, -k_m * spring.rest_length - spring.gravity])
    s = np.array([y, v])
    s = s + dt * (A @ s + b)
    return float(s[0]), float(s[1])


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
