import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    x = x.copy()
    v = v.copy()
    for i, p in enumerate(x):
        r = p - circle.centre
        d = np.hypot(r[0], r[1])
        if d < circle.radius:
            x[i] = circle.centre + r * circle.radius / d
            if np.dot(v[i], r) < 0:
                v[i] = 0
    return x, v
