"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

import numpy as np

EXERCISE = 5
SEED = "example"

import json
from pathlib import Path

par = json.loads(Path(__file__).with_name("parameters.json").read_text())
m, k, c, n = (par[name] for name in ("mass", "stiffness", "damping", "masses"))


def kick_drift():
    """The largest stable dt [s] of kick-drift, one mass without damping."""
    return np.sqrt(m / k)


def runge_kutta():
    """The largest stable dt [s] of classic Runge-Kutta, one mass without damping."""
    return 2 * np.sqrt(2) * np.sqrt(m / k)


def euler():
    """The largest stable dt [s] of Euler, one mass with damping."""
    A = np.array([[0.0, 1.0], [-k / m, -c]])
    ev = np.linalg.eigvals(A)
    return np.min(-2 * np.real(ev) / np.abs(ev) ** 2)


def string():
    """The largest stable dt [s] of kick-drift, a string."""
    K = 2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1)
    K[-1, -1] -= 1
    return 2 / np.sqrt(np.linalg.eigvalsh(k / m * K).max())


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
