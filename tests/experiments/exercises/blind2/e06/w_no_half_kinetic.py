import numpy as np

EXERCISE = 6


def energy(x, v, string):
    ek = np.sum(string.masses[:, None] * v**2)
    prev = np.vstack([string.anchor, x[:-1]])
    L = np.linalg.norm(x - prev, axis=1)
    es = 0.5 * np.sum(string.stiffness * (L - string.rest_lengths) ** 2)
    eg = string.gravity * np.sum(string.masses * x[:, 1])
    return ek, es, eg


def power(x, v, string):
    d = x - np.vstack([string.anchor, x[:-1]])
    u = v - np.vstack([np.zeros(2), v[:-1]])
    e = d / np.linalg.norm(d, axis=1)[:, None]
    rate = np.sum(u * e, axis=1)
    return -np.sum(string.damping * rate**2) - string.drag * np.sum(v**2)
