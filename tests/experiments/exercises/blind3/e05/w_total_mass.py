"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

import numpy as np

EXERCISE = 5
SEED = "example"

import json
from pathlib import Path

settings = json.loads(Path(__file__).with_name("parameters.json").read_text())


class Numbers:
    m = settings["mass"]
    k = settings["stiffness"]
    c = settings["damping"]
    n = settings["masses"]


def kick_drift():
    """The largest stable dt [s] of kick-drift, one mass without damping."""
    return 2 / np.sqrt(Numbers.k / Numbers.m)


def runge_kutta():
    """The largest stable dt [s] of classic Runge-Kutta, one mass without damping."""
    return 2 * np.sqrt(2 * Numbers.m / Numbers.k)


def euler():
    """The largest stable dt [s] of Euler, one mass with damping."""
    return Numbers.c / Numbers.k


def string():
    """The largest stable dt [s] of kick-drift, a string."""
    n = Numbers.n
    w0 = np.sqrt(Numbers.k / (n * Numbers.m))
    modes = [2 * w0 * np.sin((2 * j - 1) * np.pi / (4 * n + 2)) for j in range(1, n + 1)]
    return 2 / max(modes)


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
