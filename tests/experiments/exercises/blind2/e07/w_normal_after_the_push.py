import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    d = circle.centre - x
    r = np.linalg.norm(d, axis=1)[:, None]
    n = d / r
    inside = r < circle.radius
    x_new = np.where(inside, circle.centre - circle.radius * n, x)
    s = np.sum(v * n, axis=1)[:, None]
    v_new = np.where(s < 0, v - s * n, v)
    return x_new, v_new
