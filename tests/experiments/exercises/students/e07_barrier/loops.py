import math

import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    x_new = np.array(x)
    v_new = np.array(v)
    for i in range(len(x)):
        dx = x[i, 0] - circle.centre[0]
        dy = x[i, 1] - circle.centre[1]
        d = math.sqrt(dx * dx + dy * dy)
        if d < circle.radius:
            nx = dx / d
            ny = dy / d
            x_new[i, 0] = circle.centre[0] + circle.radius * nx
            x_new[i, 1] = circle.centre[1] + circle.radius * ny
            vn = v[i, 0] * nx + v[i, 1] * ny
            if vn < 0:
                v_new[i, 0] = v[i, 0] - vn * nx
                v_new[i, 1] = v[i, 1] - vn * ny
    return x_new, v_new
