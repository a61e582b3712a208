import math

import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    x, v = np.array(x), np.array(v)
    for i in range(len(x)):
        dx, dy = x[i] - circle.centre
        r = math.hypot(dx, dy)
        if r < circle.radius:
            x[i] = circle.centre + np.array([dx, dy]) * (circle.radius / r)
            inwards = (v[i][0] * dx + v[i][1] * dy) / r
            if inwards < 0:
                v[i] = v[i] - inwards * np.array([dx, dy]) / r
    return x, v
