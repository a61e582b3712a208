import numpy as np

EXERCISE = 3


def forces(x, v, string):
    result = []
    n = x.shape[0]
    for i in range(n):
        up = x[i - 1] if i > 0 else string.anchor
        r = up - x[i]
        L = np.linalg.norm(r)
        f = string.stiffness[i] * (L - string.rest_lengths[i]) / L * r
        if i < n - 1:
            r = x[i + 1] - x[i]
            L = np.linalg.norm(r)
            f = f + string.stiffness[i + 1] * (L - string.rest_lengths[i + 1]) / L * r
        f = f - string.masses[i] * string.drag * v[i]
        f = f + string.masses[i] * np.array([0, -string.gravity])
        result.append(f)
    return np.array(result)
