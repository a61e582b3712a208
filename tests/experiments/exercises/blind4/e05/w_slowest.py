"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

import numpy as np

EXERCISE = 5
SEED = "ada"


m, k, c, n = 0.158, 196.7, 0.115, 3


def kick_drift():
    """The largest stable dt [s] of kick-drift, one mass without damping."""
    # trace of the matrix: 2 - w^2 dt^2 >= -2
    return np.sqrt(4 * m / k)


def runge_kutta():
    """The largest stable dt [s] of classic Runge-Kutta, one mass without damping."""
    # |R(iz)|^2 = 1 - z^6/72 + z^8/576
    return np.sqrt(8 * m / k)


def euler():
    """The largest stable dt [s] of Euler, one mass with damping."""
    return c / k


def string():
    """The largest stable dt [s] of kick-drift, a string."""
    j = np.arange(1, n + 1)
    modes = 2 * np.sqrt(k / m) * np.sin((2 * j - 1) * np.pi / (4 * n + 2))
    return 2 / modes.min()


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
