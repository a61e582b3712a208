"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

import numpy as np

EXERCISE = 5
SEED = "example"

mass = 0.026
stiffness = 474.8
damping = 0.229
masses = 3


def kick_drift():
    """The largest stable dt [s] of kick-drift, one mass without damping."""
    return 2 * (mass / stiffness) ** 0.5


def runge_kutta():
    """The largest stable dt [s] of classic Runge-Kutta, one mass without damping."""
    return 8**0.5 * (mass / stiffness) ** 0.5


def euler():
    """The largest stable dt [s] of Euler, one mass with damping."""
    return 2 * mass / damping


def string():
    """The largest stable dt [s] of kick-drift, a string."""
    import math

    angle = (2 * masses - 1) * math.pi / (2 * (2 * masses + 1))
    return (mass / stiffness) ** 0.5 / math.sin(angle)


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
