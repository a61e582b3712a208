import numpy as np

EXERCISE = 4


def force(i, x, v, s):
    n = len(x)
    above = s.anchor if i == 0 else x[i - 1]
    d = above - x[i]
    L = np.linalg.norm(d)
    f = s.stiffness[i] * (L - s.rest_lengths[i]) * d / L
    if i + 1 < n:
        d = x[i + 1] - x[i]
        L = np.linalg.norm(d)
        f = f + s.stiffness[i + 1] * (L - s.rest_lengths[i + 1]) * d / L
    return f - s.drag * v[i] - np.array([0.0, s.masses[i] * s.gravity])


def step(x, v, dt, string):
    x, v = x.copy(), v.copy()
    for i in range(len(x)):
        x0, v0 = x[i].copy(), v[i].copy()
        a1 = force(i, x, v, string) / string.masses[i]
        x[i], v[i] = x0 + dt * v0, v0 + dt * a1
        a2 = force(i, x, v, string) / string.masses[i]
        x[i], v[i] = x0 + dt * (v0 + v[i]) / 2, v0 + dt * (a1 + a2) / 2
    return x, v
