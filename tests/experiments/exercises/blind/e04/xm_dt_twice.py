import numpy as np

EXERCISE = 4


def forces(x, v, string):
    n = len(x)
    F = np.zeros((n, 2))
    for i in range(n):
        if i == 0:
            d = x[0] - string.anchor
        else:
            d = x[i] - x[i - 1]
        L = np.sqrt(d[0] ** 2 + d[1] ** 2)
        T = string.stiffness[i] * (L - string.rest_lengths[i])
        f = T * d / L
        F[i] -= f
        if i > 0:
            F[i - 1] += f
        F[i, 1] -= string.masses[i] * string.gravity
        F[i] -= string.drag * v[i]
    return F


def step(x, v, dt, string):
    M = string.masses[:, None]
    a1 = forces(x, v, string) / M
    xg = x + dt * v
    vg = v + dt * a1
    a2 = forces(xg, vg, string) / M
    v_new = v + dt**2 * (a1 + a2) / 2
    x_new = x + dt * (v + vg) / 2
    return x_new, v_new
