"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

import numpy as np

EXERCISE = 5
SEED = "example"

mass, stiffness, damping, masses = 0.026, 474.8, 0.229, 3
w = np.sqrt(stiffness / mass)


def kick_drift():
    """The largest stable dt [s] of kick-drift, one mass without damping."""
    return 2 / w


def runge_kutta():
    """The largest stable dt [s] of classic Runge-Kutta, one mass without damping."""
    return 2 / w


def euler():
    """The largest stable dt [s] of Euler, one mass with damping."""
    return damping / stiffness


def string():
    """The largest stable dt [s] of kick-drift, a string."""
    K = np.eye(masses) * 2
    K[-1, -1] = 1
    for i in range(masses - 1):
        K[i, i + 1] = K[i + 1, i] = -1
    w_max = np.linalg.eigvalsh(K * stiffness / mass).max()
    return 2 / w_max


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
