import numpy as np

EXERCISE = 3


def forces(x, v, string):
    n = len(x)
    F = np.zeros((n, 2))
    for i in range(n):
        if i == 0:
            d = x[0] - string.anchor
        else:
            d = x[i] - x[i - 1]
        L = np.sqrt(d[0] ** 2 + d[1] ** 2)
        T = string.stiffness[i] * (L - string.rest_lengths[i])
        f = T * d / L
        pass
        if i > 0:
            pass
    return F
