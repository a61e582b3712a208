import numpy as np

EXERCISE = 6


def springs(x, v, string):
    d = np.diff(np.vstack([string.anchor, x]), axis=0)
    w = np.diff(np.vstack([[0, 0], v]), axis=0)
    length = np.linalg.norm(d, axis=1)
    return d, w, length


def energy(x, v, string):
    d, w, length = springs(x, v, string)
    kinetic = 0.5 * np.sum(string.masses[:, None] * v**2)
    elastic = 0.5 * np.sum(string.stiffness * (length - string.rest_lengths) ** 2)
    weight = np.sum(string.masses * string.gravity * x[:, 1])
    return kinetic, elastic, weight


def power(x, v, string):
    d, w, length = springs(x, v, string)
    rate = np.sum(w * d, axis=1) / length
    return -np.sum(string.damping * rate**2) - string.drag * np.sum(v**2)
