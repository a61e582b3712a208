"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

import numpy as np

EXERCISE = 5
SEED = "example"

import json
from pathlib import Path

N = json.loads(Path(__file__).with_name("parameters.json").read_text())
W2 = N["stiffness"] / N["mass"]
GAMMA = N["damping"] / N["mass"]


def chain(y):
    """Accelerations of a string without damping, gravity left out."""
    ends = np.concatenate(([0.0], y, y[-1:]))
    return W2 * (ends[:-2] - 2 * y + ends[2:])


def kd(z, h):
    y, v = np.split(z, 2)
    v = v + h * chain(y)
    return np.concatenate((y + h * v, v))


def rk(z, h):
    f = lambda s: np.array([s[1], -W2 * s[0]])
    a = f(z)
    b = f(z + h / 2 * a)
    c = f(z + h / 2 * b)
    d = f(z + h * c)
    return z + h / 6 * (a + 2 * b + 2 * c + d)


def eu(z, h):
    return z + h * np.array([z[1], -W2 * z[0] - GAMMA * z[1]])


def largest(method, size):
    low, high = 0.0, 100 / W2**0.5
    while high - low > 1e-9 * high:
        h = (low + high) / 2
        M = np.column_stack([method(e, h) for e in np.eye(size)])
        if np.abs(np.linalg.eigvals(M)).max() > 1 + 1e-7:
            high = h
        else:
            low = h
    return low


def kick_drift():
    """The largest stable dt [s] of kick-drift, one mass without damping."""
    return largest(kd, 2)


def runge_kutta():
    """The largest stable dt [s] of classic Runge-Kutta, one mass without damping."""
    return largest(rk, 2)


def euler():
    """The largest stable dt [s] of Euler, one mass with damping."""
    return largest(eu, 2)


def string():
    """The largest stable dt [s] of kick-drift, a string."""
    return largest(kd, 2 * N["masses"])


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
