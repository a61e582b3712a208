import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    r = x - circle.centre
    dist = np.linalg.norm(r, axis=1, keepdims=True)
    n = r / dist
    inside = dist < circle.radius
    vn = np.sum(v * n, axis=1, keepdims=True)
    xx = np.where(inside, circle.centre + circle.radius * n, x)
    vv = np.where(inside & (vn < 0), v - vn * n, v)
    return xx, vv
