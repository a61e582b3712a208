import numpy as np

EXERCISE = 4


def acceleration(x, v, string):
    a = np.zeros_like(x)
    up = string.anchor
    for i in range(len(x)):
        r = up - x[i]
        L = np.sqrt(r[0] ** 2 + r[1] ** 2)
        f = string.stiffness[i] * (L - string.rest_lengths[i]) * r / L
        a[i] += f
        if i > 0:
            a[i - 1] -= f
        up = x[i]
    a -= string.drag * v
    a = a / string.masses[0]
    a[:, 1] -= string.gravity
    return a


def step(x, v, dt, string):
    k1x, k1v = v, acceleration(x, v, string)
    k2x = v + dt * k1v
    k2v = acceleration(x + dt * k1x, v + dt * k1v, string)
    return x + dt * (k1x + k2x) / 2, v + dt * (k1v + k2v) / 2
