"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

import math

EXERCISE = 5
SEED = "example"

p = {"mass": 0.026, "stiffness": 474.8, "damping": 0.229, "masses": 3}


def w0():
    return (p["stiffness"] / p["mass"]) ** 0.5


def kick_drift():
    """The largest stable dt [s] of kick-drift, one mass without damping."""
    return 2 / w0()


def runge_kutta():
    """The largest stable dt [s] of classic Runge-Kutta, one mass without damping."""
    return 2 * math.sqrt(2) / w0()


def euler():
    """The largest stable dt [s] of Euler, one mass with damping."""
    # |1 + dt * lambda| <= 1
    decay = p["damping"] / p["mass"]
    return 2 / decay


def string():
    """The largest stable dt [s] of kick-drift, a string."""
    n = p["masses"]
    fastest = 2 * w0() * math.sin((2 * n - 1) * math.pi / (2 * (2 * n + 1)))
    return 2 / fastest


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
