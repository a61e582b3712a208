"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

import json
import os

import numpy as np

EXERCISE = 5
SEED = "example"

with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "parameters.json")) as file:
    par = json.load(file)


def omega():
    return np.sqrt(par["stiffness"] / par["mass"])


def kick_drift():
    """The largest stable dt [s] of kick-drift, one mass without damping."""
    return 2 / omega()


def runge_kutta():
    """The largest stable dt [s] of classic Runge-Kutta, one mass without damping."""
    return 2.785 / omega()


def euler():
    """The largest stable dt [s] of Euler, one mass with damping."""
    return par["damping"] / par["stiffness"]


def string():
    """The largest stable dt [s] of kick-drift, a string."""
    n = par["masses"]
    K = np.diag([2.0] * (n - 1) + [1.0])
    for i in range(n - 1):
        K[i, i + 1] = K[i + 1, i] = -1
    w_max = omega() * np.sqrt(np.linalg.eigvalsh(K)[-1])
    return 2 / w_max


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
