import numpy as np

EXERCISE = 3


def pull(a, b, k, L0):
    d = b - a
    L = np.sqrt(d[0] ** 2 + d[1] ** 2)
    return k * (L - L0) * d / L


def forces(x, v, string):
    n = len(x)
    out = np.zeros_like(x)
    for i in range(n):
        top = string.anchor if i == 0 else x[i - 1]
        out[i] = pull(x[i], top, string.stiffness[i], string.rest_lengths[i])
        if i + 1 < n:
            out[i] += pull(x[i], x[i + 1], string.stiffness[i], string.rest_lengths[i])
        out[i] += np.array([0.0, -string.masses[i] * string.gravity])
        out[i] -= string.drag * v[i]
    return out
