import numpy as np

EXERCISE = 6


def energy(x, v, string):
    K = np.dot(string.masses, v[:, 0] ** 2 + v[:, 1] ** 2) / 2
    d = x - np.vstack([string.anchor, x[:-1]])
    L = np.sqrt(d[:, 0] ** 2 + d[:, 1] ** 2)
    S = np.dot(string.stiffness, (L - string.rest_lengths) ** 2) / 2
    return K, S, np.dot(string.masses, x[:, 1]) * string.gravity


def power(x, v, string):
    d = x - np.vstack([string.anchor, x[:-1]])
    u = v - np.vstack([[0, 0], v[:-1]])
    rate = (d * u).sum(axis=1) / np.sqrt((d * d).sum(axis=1))
    return np.dot(string.damping, rate**2) + string.drag * (v * v).sum()
