import json
from pathlib import Path

import numpy as np

EXERCISE = 5
SEED = "example"
p = json.loads(Path(__file__).with_name("parameters.json").read_text())
m, k, c, n = p["mass"], p["stiffness"], p["damping"], int(p["masses"])


def kick_drift():
    return 2 * np.sqrt(m / k)


def runge_kutta():
    return 2.8284 * np.sqrt(m / k)


def euler():
    return np.float32(c / k)


def string():
    L = np.diag([2.0] * (n - 1) + [1.0]) - np.diag([1.0] * (n - 1), 1) - np.diag([1.0] * (n - 1), -1)
    return 2 / np.sqrt(k / m * np.linalg.eigvalsh(L)[-1])
