import numpy as np

EXERCISE = 6


def energy(x, v, string):
    kin = 0.0
    ela = 0.0
    pot = 0.0
    prev = string.anchor
    for i in range(len(x)):
        kin += 0.5 * string.masses[i] * (v[i, 0] ** 2 + v[i, 1] ** 2)
        l = np.linalg.norm(x[i] - prev)
        ela += 0.5 * string.stiffness[i] * (l - string.rest_lengths[i]) ** 2
        pot += string.masses[i] * string.gravity * x[i, 1]
        prev = x[i]
    return kin, ela, pot


def power(x, v, string):
    P = 0.0
    prev, vprev = string.anchor, np.zeros(2)
    for i in range(len(x)):
        d = x[i] - prev
        e = d / np.linalg.norm(d)
        rate = np.dot(v[i] - vprev, e)
        if i > 0:
            P -= string.damping[i] * rate**2
        P -= string.drag * np.dot(v[i], v[i])
        prev, vprev = x[i], v[i]
    return P
