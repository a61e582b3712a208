"""Exercise 2: one mass on a spring, by Heun's step. Run me: python heun.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 2


def slopes(state, spring):
    y, v = state
    F = spring.stiffness * (-y - spring.rest_length) - spring.mass * spring.gravity - spring.damping * v
    return np.array([v, F / spring.mass])


def step(y, v, dt, spring):
    """From height y [m] and velocity v [m/s], those after dt [s]."""
    state = np.array([y, v])
    here = slopes(state, spring)
    guess = state + dt * here
    there = slopes(guess, spring)
    state = state + dt * (here + there)
    return state[0], state[1]


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
