import math

import numpy as np

EXERCISE = 3


def forces(x, v, string):
    n = len(x)
    F = np.zeros((n, 2))
    for i in range(n):
        m = string.masses[i]
        # weight and drag
        F[i, 0] = -string.drag * v[i, 0]
        F[i, 1] = -m * string.gravity - string.drag * v[i, 1]
        # spring above
        if i == 0:
            dx = string.anchor[0] - x[i, 0]
            dy = string.anchor[1] - x[i, 1]
        else:
            dx = x[i - 1, 0] - x[i, 0]
            dy = x[i - 1, 1] - x[i, 1]
        length = math.sqrt(dx**2 + dy**2)
        f = string.stiffness[i] * (length - string.rest_lengths[i])
        F[i, 0] += f * dx / length
        F[i, 1] += f * dy / length
        # spring below
        if i < n - 1:
            dx = x[i + 1, 0] - x[i, 0]
            dy = x[i + 1, 1] - x[i, 1]
            length = math.sqrt(dx**2 + dy**2)
            f = string.stiffness[i + 1] * (length - string.rest_lengths[i + 1])
            F[i, 0] += f * dx / length
            F[i, 1] += f * dy / length
    return F
