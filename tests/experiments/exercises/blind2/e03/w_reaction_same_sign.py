import numpy as np

EXERCISE = 3


def forces(x, v, string):
    F = np.zeros((len(x), 2))
    for i, (k, l0) in enumerate(zip(string.stiffness, string.rest_lengths)):
        a = string.anchor if i == 0 else x[i - 1]
        e = x[i] - a
        l = np.sqrt(e @ e)
        s = k * (l - l0) * (e / l)
        F[i] -= s
        if i >= 1:
            F[i - 1] -= s
    for i in range(len(x)):
        F[i][1] -= string.masses[i] * string.gravity
        F[i] -= string.drag * v[i]
    return F
