import numpy as np

EXERCISE = 4


def acceleration(x, v, s):
    out = np.zeros((len(x), 2))
    below = np.zeros(2)
    for i in reversed(range(len(x))):
        top = x[i - 1] if i else s.anchor
        d = top - x[i]
        L = d.dot(d) ** 0.5
        T = s.stiffness[i] * (L - s.rest_lengths[i]) * d / L
        out[i] = (T - below - s.drag * v[i]) / s.masses[i]
        out[i, 1] -= s.gravity
        below = T
    return out


def step(x, v, dt, s):
    a = acceleration(x, v, s)
    b = acceleration(x + dt * v, v + dt * a, s)
    return x + dt * v + dt**2 / 2 * a, v + dt / 2 * (a + b)
