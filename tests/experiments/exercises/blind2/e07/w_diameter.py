import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    rel = x - circle.centre
    dist = np.linalg.norm(rel, axis=1, keepdims=True)
    n = rel / dist
    inside = dist < circle.radius
    x_new = np.where(inside, circle.radius * n, x)
    vn = np.minimum(np.sum(v * n, axis=1, keepdims=True), 0)
    v_new = np.where(inside, v - vn * n, v)
    return x_new, v_new
