import numpy as np


def step(f, y, t, dt):
    x, v = np.split(y, 2)
    x = x + dt * v
    a = np.split(f(np.concatenate([x, v]), t + dt), 2)[1]
    return np.concatenate([x, v + dt * a])
