import numpy as np

EXERCISE = 6


def energy(x, v, string):
    kinetic = springs = height = 0.0
    for i in range(len(x)):
        kinetic += 0.5 * string.masses[i] * (v[i] @ v[i])
        top = x[i - 1] if i > 0 else string.anchor
        springs += 0.5 * string.stiffness[i] * (np.linalg.norm(x[i] - top) - string.rest_lengths[i]) ** 2
        height += string.masses[i] * string.gravity * x[i, 1]
    return kinetic, springs, height


def power(x, v, string):
    p = 0.0
    for i in range(len(x)):
        rel = v[i] - (v[i - 1] if i > 0 else np.zeros(2))
        p -= string.damping[i] * np.dot(rel, rel)
        p -= string.drag * np.dot(v[i], v[i])
    return p
