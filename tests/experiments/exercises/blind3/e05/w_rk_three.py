"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

EXERCISE = 5
SEED = "example"

import json
from math import factorial
from pathlib import Path

import numpy as np

numbers = json.loads((Path(__file__).resolve().parent / "parameters.json").read_text())
m = numbers["mass"]
k = numbers["stiffness"]
c = numbers["damping"]
n = numbers["masses"]


def limit(step_matrix, high):
    """Largest dt at which no eigenvalue is larger than 1, by bisection."""
    low = 0.0
    for _ in range(100):
        mid = (low + high) / 2
        if max(abs(np.linalg.eigvals(step_matrix(mid)))) > 1 + 1e-10:
            high = mid
        else:
            low = mid
    return low


def kick_drift():
    """The largest stable dt [s] of kick-drift, one mass without damping."""
    return 2 / np.sqrt(k / m)


def runge_kutta():
    """The largest stable dt [s] of classic Runge-Kutta, one mass without damping."""
    A = np.array([[0, 1], [-k / m, 0]])

    def M(dt):
        return sum(np.linalg.matrix_power(dt * A, i) / factorial(i) for i in range(4))

    return limit(M, 5 / np.sqrt(k / m))


def euler():
    """The largest stable dt [s] of Euler, one mass with damping."""
    A = np.array([[0, 1], [-k / m, -c / m]])
    return limit(lambda dt: np.eye(2) + dt * A, 5 / np.sqrt(k / m))


def string():
    """The largest stable dt [s] of kick-drift, a string."""
    K = np.diag(np.full(n, 2.0 * k)) - k * np.eye(n, k=1) - k * np.eye(n, k=-1)
    K[n - 1, n - 1] = k
    return 2 / np.sqrt(max(np.linalg.eigvalsh(K / m)))


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
