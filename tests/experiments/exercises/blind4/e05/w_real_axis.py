"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

from math import pi, sin, sqrt

EXERCISE = 5
SEED = "ada"


MASS, STIFFNESS, DAMPING, MASSES = 0.158, 196.7, 0.115, 3
W = sqrt(STIFFNESS / MASS)


def kick_drift():
    """The largest stable dt [s] of kick-drift, one mass without damping."""
    return 2 / W


def runge_kutta():
    """The largest stable dt [s] of classic Runge-Kutta, one mass without damping."""
    return 2.785 / W


def euler():
    """The largest stable dt [s] of Euler, one mass with damping."""
    return DAMPING / STIFFNESS


def string():
    """The largest stable dt [s] of kick-drift, a string."""
    fastest = 2 * W * sin((2 * MASSES - 1) / (2 * MASSES + 1) * pi / 2)
    return 2 / fastest


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
