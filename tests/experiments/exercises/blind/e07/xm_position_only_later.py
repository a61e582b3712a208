import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    x = x.copy()
    v = v.copy()
    for i in range(len(x)):
        d = x[i] - circle.centre
        r = np.linalg.norm(d)
        if r < circle.radius:
            n = d / r
            x[i] = circle.centre + circle.radius * n
            n = x[i] / np.linalg.norm(x[i])
            vn = np.dot(v[i], n)
            if vn < 0:
                v[i] = v[i] - vn * n
    return x, v
