import numpy as np

EXERCISE = 4


def f(i, x, v, s):
    above = s.anchor if i == 0 else x[i - 1]
    d = above - x[i]
    L = np.linalg.norm(d)
    F = s.stiffness[i] * (L - s.rest_lengths[i]) * d / L
    if i < len(x) - 1:
        d = x[i + 1] - x[i]
        L = np.linalg.norm(d)
        F = F + s.stiffness[i + 1] * (L - s.rest_lengths[i + 1]) * d / L
    return (F - s.drag * v[i]) / s.masses[i] + np.array([0, -s.gravity])


def step(x, v, dt, string):
    n = len(x)
    a1 = np.array([f(i, x, v, string) for i in range(n)])
    xg, vg = x + dt * v, v + dt * a1
    xn, vn = xg.copy(), vg.copy()
    for i in range(n - 1):
        a2 = f(i, xg, vg, string)
        xn[i] = x[i] + dt / 2 * (v[i] + vg[i])
        vn[i] = v[i] + dt / 2 * (a1[i] + a2)
        xg[i] = xn[i]
    return xn, vn
