import numpy as np

EXERCISE = 3


def tension(p, q, k, l0):
    d = q - p
    l = np.linalg.norm(d)
    return k * max(0.0, l - l0) * d / l


def forces(x, v, string):
    chain = [string.anchor, *x]
    F = [np.zeros(2) for _ in x]
    for i in range(len(x)):
        t = tension(chain[i + 1], chain[i], string.stiffness[i], string.rest_lengths[i])
        F[i] = F[i] + t - np.array([0, string.masses[i] * string.gravity]) - string.drag * v[i]
        if i > 0:
            F[i - 1] = F[i - 1] - t
    return np.array(F)
