"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

EXERCISE = 5
SEED = "example"

import json
import math
import pathlib

p = json.load(open(pathlib.Path(__file__).with_name("parameters.json")))


def frequency():
    return math.sqrt(p["stiffness"] / p["mass"]) / (2 * math.pi)


def kick_drift():
    """The largest stable dt [s] of kick-drift, one mass without damping."""
    return 2 / frequency()


def runge_kutta():
    """The largest stable dt [s] of classic Runge-Kutta, one mass without damping."""
    return math.sqrt(8) / (2 * math.pi * frequency())


def euler():
    """The largest stable dt [s] of Euler, one mass with damping."""
    # complex eigenvalues: |1 + dt lambda| = 1
    re = -p["damping"] / (2 * p["mass"])
    size2 = p["stiffness"] / p["mass"]
    return -2 * re / size2


def string():
    """The largest stable dt [s] of kick-drift, a string."""
    n = p["masses"]
    s = math.cos(2 * math.pi / (2 * n + 1))  # largest eigenvalue 2 + 2 s
    return 2 / (2 * math.pi * frequency() * math.sqrt(2 + 2 * s))


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
