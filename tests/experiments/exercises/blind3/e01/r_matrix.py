"""Exercise 1: one mass on a spring, by Euler's step. Run me: python euler.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 1


def step(y, v, dt, spring):
    """From height y [m] and velocity v [m/s], those after dt [s]."""
    m, k, c = spring.mass, spring.stiffness, spring.damping
    A = np.array(
        [
            [0.0, 1.0, 0.0],
            [-k / m, -c / m, -k * spring.rest_length / m - spring.gravity],
            [0.0, 0.0, 0.0],
        ]
    )
    y_new, v_new, _ = (np.eye(3) + dt * A) @ np.array([y, v, 1.0])
    return float(y_new), float(v_new)


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
