import numpy as np

EXERCISE = 4


def acc(x, v, i, s):
    f = np.array([0.0, -s.masses[i] * s.gravity]) - s.drag * v[i]
    for other, j in ((s.anchor if i == 0 else x[i - 1], i), (x[i + 1] if i + 1 < len(x) else None, i + 1)):
        if other is not None:
            d = other - x[i]
            f = f + s.stiffness[j] * (np.linalg.norm(d) - s.rest_lengths[j]) * d / np.linalg.norm(d)
    return f / s.masses[i]


def step(x, v, dt, s):
    n = len(x)
    gx, gv, first = x.copy(), v.copy(), []
    for i in range(n):
        first.append(acc(x, v, i, s))
        gx[i] = x[i] + dt * v[i]
        gv[i] = v[i] + dt * first[i]
    nx, nv = x.copy(), v.copy()
    for i in range(n):
        nx[i] += dt * (v[i] + gv[i]) / 2
        nv[i] += dt * (first[i] + acc(gx, gv, i, s)) / 2
    return nx, nv
