import numpy as np

EXERCISE = 6


def lengths(x, s):
    return np.linalg.norm(np.diff(np.vstack([s.anchor, x]), axis=0), axis=1)


def energy(x, v, string):
    T = (string.masses * (v**2).sum(1)).sum() / 2
    U = (string.stiffness * (lengths(x, string) - string.rest_lengths) ** 2).sum() / 2
    W = (string.masses * string.gravity * (x[:, 1] - string.anchor[1])).sum()
    return T, U, W


def power(x, v, string):
    d = np.diff(np.vstack([string.anchor, x]), axis=0)
    w = np.diff(np.vstack([[0, 0], v]), axis=0)
    closing = (d * w).sum(1) / lengths(x, string)
    return -(string.damping * closing**2).sum() - string.drag * (v**2).sum()
