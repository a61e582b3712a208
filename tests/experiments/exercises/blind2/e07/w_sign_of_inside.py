import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    X, V = [], []
    for p, u in zip(x, v):
        d = p - circle.centre
        r = np.sqrt(d @ d)
        if r > circle.radius:
            n = d / r
            p = circle.centre + n * circle.radius
            inward = min(0.0, u @ n)
            u = u - inward * n
        X.append(p)
        V.append(u)
    return np.array(X), np.array(V)
