"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

import math

EXERCISE = 5
SEED = "ada"


MASS = 0.158
STIFFNESS = 196.7
DAMPING = 0.115
COUNT = 3


def frequency(k, m):
    """rad/s"""
    return math.sqrt(k / m)


def kick_drift():
    """The largest stable dt [s] of kick-drift, one mass without damping."""
    f = frequency(STIFFNESS, MASS) / (2 * math.pi)
    return 2 / f


def runge_kutta():
    """The largest stable dt [s] of classic Runge-Kutta, one mass without damping."""
    return 2.8284 / frequency(STIFFNESS, MASS)


def euler():
    """The largest stable dt [s] of Euler, one mass with damping."""
    return DAMPING / STIFFNESS


def string():
    """The largest stable dt [s] of kick-drift, a string."""
    return 1 / (frequency(STIFFNESS, MASS) * math.sin(5 * math.pi / 14))


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
