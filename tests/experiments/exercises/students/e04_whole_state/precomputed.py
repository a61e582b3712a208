import numpy as np

EXERCISE = 4
CACHE = {}


def neighbours(n):
    if n not in CACHE:
        CACHE[n] = [[(i - 1, i)] + ([(i + 1, i + 1)] if i + 1 < n else []) for i in range(n)]
    return CACHE[n]


def acceleration(x, v, s):
    a = np.empty_like(x)
    for i, springs in enumerate(neighbours(len(x))):
        f = -s.drag * v[i] - np.array([0, s.masses[i] * s.gravity])
        for other, spring in springs:
            d = (x[other] if other >= 0 else s.anchor) - x[i]
            f += s.stiffness[spring] * (1 - s.rest_lengths[spring] / np.sqrt(d @ d)) * d
        a[i] = f / s.masses[i]
    return a


def step(x, v, dt, s):
    a = acceleration(x, v, s)
    gx, gv = x + v * dt, v + a * dt
    b = acceleration(gx, gv, s)
    return 0.5 * (x + gx + gv * dt), 0.5 * (v + gv + b * dt)
