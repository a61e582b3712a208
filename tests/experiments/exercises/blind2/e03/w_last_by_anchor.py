import numpy as np

EXERCISE = 3


def forces(x, v, string):
    n = len(x)
    F = np.zeros((n, 2))
    for i in range(n):
        above = x[i - 1] if i > 0 else string.anchor
        d = above - x[i]
        F[i] += string.stiffness[i] * (np.linalg.norm(d) - string.rest_lengths[i]) * d / np.linalg.norm(d)
        j = (i + 1) % n
        if j != i:
            d = x[j] - x[i]
            F[i] += string.stiffness[j] * (np.linalg.norm(d) - string.rest_lengths[j]) * d / np.linalg.norm(d)
        F[i] += [0, -string.masses[i] * string.gravity]
        F[i] += -string.drag * v[i]
    return F
