"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

import json
import math

import numpy as np

EXERCISE = 5
SEED = "example"

with open("parameters.json") as file:
    P = json.load(file)


def kick_drift():
    """The largest stable dt [s] of kick-drift, one mass without damping."""
    frequency = math.sqrt(P["stiffness"] / P["mass"]) / (2 * math.pi)
    return 2 / frequency


def runge_kutta():
    """The largest stable dt [s] of classic Runge-Kutta, one mass without damping."""
    return math.sqrt(8 * P["mass"] / P["stiffness"])


def euler():
    """The largest stable dt [s] of Euler, one mass with damping."""
    eigenvalues = np.roots([P["mass"], P["damping"], P["stiffness"]])
    s = eigenvalues[0]
    return float(-2 * s.real / abs(s) ** 2)


def string():
    """The largest stable dt [s] of kick-drift, a string."""
    n = P["masses"]
    K = np.zeros((n, n))
    for i in range(n):
        K[i, i] += P["stiffness"]
        if i > 0:
            K[i - 1, i - 1] += P["stiffness"]
            K[i, i - 1] = K[i - 1, i] = -P["stiffness"]
    w = math.sqrt(max(np.linalg.eigvalsh(K / P["mass"])))
    return 2 / w


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
