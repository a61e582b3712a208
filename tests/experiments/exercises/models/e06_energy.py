import numpy as np

EXERCISE = 6


def energy(x, v, string):
    length = np.linalg.norm(np.vstack([string.anchor, x[:-1]]) - x, axis=1)
    kinetic = (string.masses * (v**2).sum(axis=1)).sum() / 2
    elastic = (string.stiffness * (length - string.rest_lengths) ** 2).sum() / 2
    return kinetic, elastic, (string.masses * x[:, 1]).sum() * string.gravity


def power(x, v, string):
    gap = np.vstack([string.anchor, x[:-1]]) - x
    direction = gap / np.linalg.norm(gap, axis=1)[:, None]
    rate = (direction * (np.vstack([np.zeros(2), v[:-1]]) - v)).sum(axis=1)
    return -(string.damping * rate**2).sum() - string.drag * (v**2).sum()
