import numpy as np


def acceleration(x, v, s):
    force = s.masses[:, None] * s.gravity - s.drag * v
    for j in range(len(s.springs)):
        a, b = s.springs[j]
        d = x[b] - x[a]
        length = np.linalg.norm(d)
        pull = s.stiffness[j] * (length - s.rest_lengths[j]) + s.damping[j] * np.dot(v[b] - v[a], d) / length
        force[a] += pull * d / length
        force[b] -= pull * d / length
    return np.where(s.fixed[:, None], 0, force / s.masses[:, None])


def step(x, v, dt, system):
    a = acceleration(x, v, system)
    x1 = x + v * dt + a * dt**2 / 2
    a1 = acceleration(x1, v + a * dt, system)
    return x1, v + (a + a1) / 2 * dt
