import numpy as np

EXERCISE = 3


def forces(x, v, string):
    F = -string.drag * v
    F[:, 0] -= string.masses * string.gravity
    previous = string.anchor
    for i in range(len(x)):
        d = x[i] - previous
        L = np.hypot(d[0], d[1])
        f = string.stiffness[i] * (L - string.rest_lengths[i]) * d / L
        F[i] -= f
        if i > 0:
            F[i - 1] += f
        previous = x[i]
    return F
