"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

EXERCISE = 5
SEED = "example"

import json, math, os

here = os.path.dirname(__file__)
with open(os.path.join(here, "parameters.json")) as f:
    q = json.load(f)

W = math.sqrt(q["stiffness"] / q["mass"])
ZETA = q["damping"] / math.sqrt(q["stiffness"] * q["mass"])


def kick_drift():
    """The largest stable dt [s] of kick-drift, one mass without damping."""
    return 2 / W


def runge_kutta():
    """The largest stable dt [s] of classic Runge-Kutta, one mass without damping."""
    return 2.828427 / W


def euler():
    """The largest stable dt [s] of Euler, one mass with damping."""
    if ZETA < 1:
        return 2 * ZETA / W
    return 2 / (W * (ZETA + math.sqrt(ZETA**2 - 1)))


def string():
    """The largest stable dt [s] of kick-drift, a string."""
    n = q["masses"]
    return 1 / (W * math.sin(math.pi * (n - 0.5) / (2 * n + 1)))


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
