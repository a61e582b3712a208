"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

import math

EXERCISE = 5
SEED = "ada"


m, k, c = 0.158, 196.7, 0.115
w = math.sqrt(k / m)


def kick_drift():
    """The largest stable dt [s] of kick-drift, one mass without damping."""
    return 1 / w


def runge_kutta():
    """The largest stable dt [s] of classic Runge-Kutta, one mass without damping."""
    return 2 * math.sqrt(2) / w


def euler():
    """The largest stable dt [s] of Euler, one mass with damping."""
    return c / k


def string():
    """The largest stable dt [s] of kick-drift, a string."""
    # neighbours move against each other: spring feels twice -> w_max = 2 w
    return 2 / (2 * w)


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
