import json
from pathlib import Path

import numpy as np

EXERCISE = 5
SEED = "example"
P = json.loads((Path(__file__).parent / "parameters.json").read_text())
m, k, c, n = P["mass"], P["stiffness"], P["damping"], P["masses"]


def limit(matrix):
    low, high = 0.0, 10.0
    trial = np.geomspace(1e-6, 10, 4000)
    for h in trial:
        if np.abs(np.linalg.eigvals(matrix(h))).max() > 1 + 1e-9:
            high = h
            break
        low = h
    for _ in range(40):
        mid = (low + high) / 2
        if np.abs(np.linalg.eigvals(matrix(mid))).max() > 1 + 1e-9:
            high = mid
        else:
            low = mid
    return low


def kick_drift():
    w2 = k / m
    return limit(lambda h: np.array([[1 - h * h * w2, h], [-h * w2, 1]]))


def runge_kutta():
    A = np.array([[0, 1], [-k / m, 0]])

    def matrix(h):
        Z = h * A
        return np.eye(2) + Z + Z @ Z / 2 + Z @ Z @ Z / 6 + Z @ Z @ Z @ Z / 24

    return limit(matrix)


def euler():
    return limit(lambda h: np.array([[1, h], [-h * k / m, 1 - h * c / m]]))


def string():
    K = 2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1)
    K[-1, -1] = 1
    return 2 / np.sqrt(np.linalg.eigvalsh(K).max() * k / m)
