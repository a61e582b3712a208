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
    x_new, v_new = xg.copy(), vg.copy()
    for i in range(len(x)):
        a2 = forces(x_new, v_new, string)[i] / M[i]
        x_new[i] = x[i] + dt * (v[i] + vg[i]) / 2
        v_new[i] = v[i] + dt * (a1[i] + a2) / 2
    return x_new, v_new
