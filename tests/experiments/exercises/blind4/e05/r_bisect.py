"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

import json
from pathlib import Path
import numpy as np

EXERCISE = 5
SEED = "ada"


P = json.loads((Path(__file__).parent / "parameters.json").read_text())
M, K, C, N = P["mass"], P["stiffness"], P["damping"], P["masses"]


def limit(matrix, lo=1e-6, hi=1.0):
    """Bisect for where the largest eigenvalue leaves the unit circle."""
    for _ in range(60):
        mid = (lo + hi) / 2
        if np.abs(np.linalg.eigvals(matrix(mid))).max() > 1 + 1e-7:
            hi = mid
        else:
            lo = mid
    return lo


def rate(c):
    return np.array([[0.0, 1.0], [-K / M, -c / M]])


def kick_drift_matrix(k, dt):
    n = len(k)
    i, o = np.eye(n), np.zeros((n, n))
    kick = np.block([[i, o], [-dt * k / M, i]])
    drift = np.block([[i, dt * i], [o, i]])
    return drift @ kick


def kick_drift():
    return limit(lambda h: kick_drift_matrix(np.array([[K]]), h))


def runge_kutta():
    def matrix(h):
        z, out, term = h * rate(0.0), np.eye(2), np.eye(2)
        for j in range(1, 5):
            term = term @ z / j
            out = out + term
        return out

    # inside, an eigenvalue is only a little below 1: start where it is clear
    return limit(matrix, lo=0.5 / np.sqrt(K / M))


def euler():
    return C / K if C * C < 4 * K * M else 2 / np.max(np.abs(np.linalg.eigvals(rate(C))))


def string():
    k = K * (2 * np.eye(N) - np.eye(N, k=1) - np.eye(N, k=-1))
    k[-1, -1] = K
    return limit(lambda h: kick_drift_matrix(k, h))


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
