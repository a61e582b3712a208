import numpy as np

EXERCISE = 3


def forces(x, v, string):
    n = len(x)
    F = np.zeros((n, 2))
    for i in range(n):
        above = string.anchor if i == 0 else x[i - 1]
        d = above - x[i]
        L = np.linalg.norm(d)
        F[i] += string.stiffness[i] * (L - string.rest_lengths[i]) * d / L
        F[i, 1] -= string.masses[i] * string.gravity
        F[i] -= string.drag * v[i]
    return F
