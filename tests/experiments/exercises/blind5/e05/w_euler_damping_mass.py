"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

import numpy as np

EXERCISE = 5
SEED = "example"

m, k, c, n = 0.026, 474.8, 0.229, 3


def size(M):
    return np.abs(np.linalg.eigvals(M)).max()


def kick_drift():
    """The largest stable dt [s] of kick-drift, one mass without damping."""
    return 2 / np.sqrt(k / m)


def runge_kutta():
    """The largest stable dt [s] of classic Runge-Kutta, one mass without damping."""
    return 2.8284 / np.sqrt(k / m)


def euler():
    """The largest stable dt [s] of Euler, one mass with damping."""
    dt = 0.0
    while True:
        dt += 1e-7
        M = np.array([[1, dt], [-k / m * dt, 1 - c * dt]])
        if size(M) > 1:
            return dt


def string():
    """The largest stable dt [s] of kick-drift, a string."""
    K = np.diag([2.0] * (n - 1) + [1.0]) - np.diag([1.0] * (n - 1), 1) - np.diag([1.0] * (n - 1), -1)
    return 2 / np.sqrt(k / m * np.linalg.eigvalsh(K)[-1])


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
