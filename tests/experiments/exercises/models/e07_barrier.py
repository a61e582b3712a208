import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    gap = x - circle.centre
    far = np.linalg.norm(gap, axis=1)[:, None]
    normal = gap / far
    inwards = np.minimum((v * normal).sum(axis=1)[:, None], 0)
    inside = far < circle.radius
    return np.where(inside, circle.centre + circle.radius * normal, x), np.where(inside, v - inwards * normal, v)
