"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

EXERCISE = 5
SEED = "example"

import json
from math import sqrt, sin, pi
from pathlib import Path

P = json.loads((Path(__file__).parent / "parameters.json").read_text())
m, k, c, n = P["mass"], P["stiffness"], P["damping"], P["masses"]
w = sqrt(k / m)


def kick_drift():
    return 2 / w


def runge_kutta():
    return 2 * sqrt(2) / w


def euler():
    return c / k


def string():
    fastest = 2 * w * sin(n * pi / (2 * (n + 1)))
    return 2 / fastest


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
