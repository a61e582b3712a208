EXERCISE = 2
import numpy as np


def F(s, p):
    return np.array([s[1], (p.stiffness * (-s[0] - p.rest_length) - p.damping * s[1]) / p.mass - p.gravity])


def step(y, v, dt, spring):
    s = np.array([y, v], dtype=float)
    d1 = dt * F(s, spring)
    d2 = dt * F(s + d1, spring)
    return s + (d1 + d2) / 2
