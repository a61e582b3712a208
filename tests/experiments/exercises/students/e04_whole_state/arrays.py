import numpy as np

EXERCISE = 4


def accelerations(x, v, s):
    gap = np.concatenate([s.anchor[None, :], x[:-1]]) - x
    length = np.sqrt(np.sum(gap**2, axis=1, keepdims=True))
    unit = gap / length
    pull = s.stiffness[:, None] * (length - s.rest_lengths[:, None]) * unit
    total = pull.copy()
    total[:-1] = total[:-1] - pull[1:]
    total[:, 1] = total[:, 1] - s.masses * s.gravity
    total = total - s.drag * v
    return total / s.masses[:, None]


def step(x, v, dt, string):
    a = accelerations(x, v, string)
    x1, v1 = x + dt * v, v + dt * a
    b = accelerations(x1, v1, string)
    new_x = x + dt * (v + v1) / 2
    new_v = v + dt * (a + b) / 2
    return new_x, new_v
