import numpy as np

EXERCISE = 6


def energy(x, v, string):
    K = 0.5 * np.sum(string.masses * np.sum(v * v, axis=1))
    d = np.diff(np.vstack([string.anchor, x]), axis=0)
    S = 0.5 * np.sum(string.stiffness * (np.hypot(d[:, 0], d[:, 1]) - string.rest_lengths) ** 2)
    W = np.sum(string.masses * x[:, 1]) * string.gravity
    return K, S, W


def power(x, v, string):
    total = -string.drag * np.sum(v * v)
    for i in range(1, len(x)):
        d = x[i] - x[i - 1]
        n = d / np.linalg.norm(d)
        total -= string.damping[i] * np.dot(v[i] - v[i - 1], n) ** 2
    return total
