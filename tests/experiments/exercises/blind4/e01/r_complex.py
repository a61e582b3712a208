"""Exercise 1: one mass on a spring, by Euler's step. Run me: python euler.py."""

from types import SimpleNamespace
import numpy as np

EXERCISE = 1


def system(spring):
    """x' = A x + b with x = (y, v)"""
    k, c, m = spring.stiffness, spring.damping, spring.mass
    A = np.array([[0.0, 1.0], [-k / m, -c / m]])
    b = np.array([0.0, -k * spring.rest_length / m - spring.gravity])
    return A, b


def step(y, v, dt, spring):
    A, b = system(spring)
    s = np.array([y, v])
    s = s + dt * (A @ s + b)
    return float(s[0]), float(s[1])


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
