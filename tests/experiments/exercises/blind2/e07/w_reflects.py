import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    x, v = x.copy(), v.copy()
    for i in range(len(x)):
        d = x[i] - circle.centre
        r = np.linalg.norm(d)
        if r < circle.radius:
            n = d / r
            x[i] = circle.centre + circle.radius * n
            vn = v[i] @ n
            if vn < 0:
                v[i] -= 2 * vn * n
    return x, v
