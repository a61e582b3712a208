"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

import math

EXERCISE = 5
SEED = "ada"


m = 0.158
k = 196.7
c = 0.115
n = 3


def kick_drift():
    """The largest stable dt [s] of kick-drift, one mass without damping."""
    w = k / m
    return 2 / w


def runge_kutta():
    """The largest stable dt [s] of classic Runge-Kutta, one mass without damping."""
    w = math.sqrt(k / m)
    return math.sqrt(8) / w


def euler():
    """The largest stable dt [s] of Euler, one mass with damping."""
    return c / k


def string():
    """The largest stable dt [s] of kick-drift, a string."""
    w = 2 * math.sqrt(k / m) * math.cos(math.pi / (2 * n + 1))
    # eigenvalues of a chain with one end free: 2 w0 cos(j pi / (2n + 1)), j = 1 is the fastest
    return 2 / w


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
