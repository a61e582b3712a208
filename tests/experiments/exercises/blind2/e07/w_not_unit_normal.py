import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    x, v = np.copy(x), np.copy(v)
    for i in range(x.shape[0]):
        n = x[i] - circle.centre
        distance = np.linalg.norm(n)
        if distance < circle.radius:
            x[i] = circle.centre + n / distance * circle.radius
            s = np.dot(n, v[i])
            if s < 0:
                v[i] = v[i] - s * n
    return x, v
