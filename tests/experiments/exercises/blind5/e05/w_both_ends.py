"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

import numpy as np

EXERCISE = 5
SEED = "example"

MASS, STIFFNESS, DAMPING, N = 0.026, 474.8, 0.229, 3


def kick_drift():
    """The largest stable dt [s] of kick-drift, one mass without damping."""
    return 2 * np.sqrt(MASS / STIFFNESS)


def runge_kutta():
    """The largest stable dt [s] of classic Runge-Kutta, one mass without damping."""
    return np.sqrt(2) * kick_drift()


def euler():
    """The largest stable dt [s] of Euler, one mass with damping."""
    return DAMPING / STIFFNESS


def string():
    """The largest stable dt [s] of kick-drift, a string."""
    matrix = np.zeros((N, N))
    for row in range(N):
        matrix[row, row] = 2 * STIFFNESS / MASS
        if row + 1 < N:
            matrix[row, row + 1] = -STIFFNESS / MASS
            matrix[row + 1, row] = -STIFFNESS / MASS
    w = np.sqrt(np.max(np.linalg.eigvalsh(matrix)))
    return 2 / w


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
