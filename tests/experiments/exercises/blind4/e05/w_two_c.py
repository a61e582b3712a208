"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

import json
import numpy as np

EXERCISE = 5
SEED = "ada"


with open("parameters.json") as file:
    p = json.load(file)

omega = np.sqrt(p["stiffness"] / p["mass"])


def kick_drift():
    """The largest stable dt [s] of kick-drift, one mass without damping."""
    return 2.0 / omega


def runge_kutta():
    """The largest stable dt [s] of classic Runge-Kutta, one mass without damping."""
    return 2.0 * np.sqrt(2.0) / omega


def euler():
    """The largest stable dt [s] of Euler, one mass with damping."""
    # |1 + dt s|^2 = 1 - dt c/m + dt^2 k/m = 1
    zeta = p["damping"] / 2 / np.sqrt(p["mass"] * p["stiffness"])
    return 4 * zeta / omega


def string():
    """The largest stable dt [s] of kick-drift, a string."""
    n = p["masses"]
    T = np.diag([2.0] * (n - 1) + [1.0]) + np.diag([-1.0] * (n - 1), 1) + np.diag([-1.0] * (n - 1), -1)
    return 2.0 / (omega * np.sqrt(np.linalg.eigvalsh(T)[-1]))


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
