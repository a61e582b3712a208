"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

from math import cos, pi, sqrt

EXERCISE = 5
SEED = "example"

mass = 0.026
stiffness = 474.8
damping = 0.229
masses = 3

omega = sqrt(stiffness / mass)


def kick_drift():
    """The largest stable dt [s] of kick-drift, one mass without damping."""
    return 2 / omega


def runge_kutta():
    """The largest stable dt [s] of classic Runge-Kutta, one mass without damping."""
    return 2.785 / omega


def euler():
    """The largest stable dt [s] of Euler, one mass with damping."""
    return damping / stiffness


def string():
    """The largest stable dt [s] of kick-drift, a string."""
    return 1 / (omega * cos(pi / (2 * masses + 1)))


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
