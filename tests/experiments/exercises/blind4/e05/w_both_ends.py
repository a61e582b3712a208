"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

import numpy as np

EXERCISE = 5
SEED = "ada"


params = dict(mass=0.158, stiffness=196.7, damping=0.115, masses=3)


def natural():
    return (params["stiffness"] / params["mass"]) ** 0.5


def kick_drift():
    """The largest stable dt [s] of kick-drift, one mass without damping."""
    return 2 / natural()


def runge_kutta():
    """The largest stable dt [s] of classic Runge-Kutta, one mass without damping."""
    return 8**0.5 / natural()


def euler():
    """The largest stable dt [s] of Euler, one mass with damping."""
    return params["damping"] / params["stiffness"]


def string():
    """The largest stable dt [s] of kick-drift, a string."""
    n = params["masses"]
    K = np.zeros((n, n))
    for i in range(n):
        K[i, i] = 2
        if i > 0:
            K[i, i - 1] = K[i - 1, i] = -1
    lam = np.linalg.eigvalsh(K).max() * params["stiffness"] / params["mass"]
    return 2 / np.sqrt(lam)


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
