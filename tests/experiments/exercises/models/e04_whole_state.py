import numpy as np

EXERCISE = 4


def acceleration(x, v, string):
    gap = np.vstack([string.anchor, x[:-1]]) - x
    length = np.linalg.norm(gap, axis=1)[:, None]
    pull = string.stiffness[:, None] * (length - string.rest_lengths[:, None]) * gap / length
    total = pull - string.drag * v
    total[:-1] -= pull[1:]
    total[:, 1] -= string.masses * string.gravity
    return total / string.masses[:, None]


def step(x, v, dt, string):
    a = acceleration(x, v, string)
    guess_x, guess_v = x + dt * v, v + dt * a
    b = acceleration(guess_x, guess_v, string)
    return x + dt * (v + guess_v) / 2, v + dt * (a + b) / 2
