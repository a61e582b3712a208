"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

from math import pi, sin, sqrt

EXERCISE = 5
SEED = "example"

m, k, c, n = 0.026, 474.8, 0.229, 3


def kick_drift():
    """The largest stable dt [s] of kick-drift, one mass without damping."""
    return sqrt(4 * m / k)


def runge_kutta():
    """The largest stable dt [s] of classic Runge-Kutta, one mass without damping."""
    return sqrt(8 * m / k)


def euler():
    """The largest stable dt [s] of Euler, one mass with damping."""
    return c / k


def string():
    """The largest stable dt [s] of kick-drift, a string."""
    modes = [2 * sqrt(k / m) * sin((2 * j - 1) * pi / (4 * n + 2)) for j in range(1, n + 1)]
    return max(2 / w for w in modes)


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
