"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

import numpy as np

EXERCISE = 5
SEED = "example"

import json
from pathlib import Path

data = json.loads(Path(__file__).with_name("parameters.json").read_text())


def kick_drift():
    return 2.0 * np.sqrt(data["mass"] / data["stiffness"])


def runge_kutta():
    return np.sqrt(2) * kick_drift()


def euler():
    A = np.array([[0, 1], [-data["stiffness"] / data["mass"], -data["damping"] / data["mass"]]])
    lam = np.linalg.eigvals(A)
    return min(-2 * lam.real / np.abs(lam) ** 2)


def string():
    n = data["masses"]
    K = 2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1)
    K[-1, -1] = 1
    w2 = np.linalg.eigvalsh(K * data["stiffness"] / data["mass"])
    return 2 / np.sqrt(w2[0])


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
