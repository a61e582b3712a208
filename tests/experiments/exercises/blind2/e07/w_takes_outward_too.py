import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    new_x, new_v = np.array(x), np.array(v)
    d = x - circle.centre
    r = np.linalg.norm(d, axis=1)
    inside = r < circle.radius
    n = d[inside] / r[inside][:, None]
    new_x[inside] = circle.centre + circle.radius * n
    radial = np.sum(v[inside] * n, axis=1)
    new_v[inside] = v[inside] - radial[:, None] * n
    return new_x, new_v
