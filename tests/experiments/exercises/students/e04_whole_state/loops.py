from math import atan2, cos, degrees, sin, sqrt  # noqa: F401

import numpy as np

EXERCISE = 4


def acceleration(px, py, vx, vy, string):
    n = len(px)
    ax, ay = [0.0] * n, [0.0] * n
    for i in range(n):
        fx, fy = 0.0, 0.0
        if i == 0:
            ux, uy = string.anchor[0], string.anchor[1]
        else:
            ux, uy = px[i - 1], py[i - 1]
        for side, ox, oy, k, rest in around(i, n, px, py, ux, uy, string):
            dx, dy = ox - px[i], oy - py[i]
            length = sqrt(dx * dx + dy * dy)
            force = k * (length - rest)
            fx += force * dx / length
            fy += force * dy / length
        fx += -string.drag * vx[i]
        fy += -string.drag * vy[i]
        fy += -string.masses[i] * string.gravity
        ax[i] = fx / string.masses[i]
        ay[i] = fy / string.masses[i]
    return ax, ay


def around(i, n, px, py, ux, uy, string):
    springs = []
    springs.append(("above", ux, uy, string.stiffness[i], string.rest_lengths[i]))
    if i + 1 < n:
        j = i + 1
        springs.append(("below", px[j], py[j], string.stiffness[j], string.rest_lengths[j]))
    return springs


def step(x, v, dt, string):
    px, py, vx, vy = (list(map(float, column)) for column in (x[:, 0], x[:, 1], v[:, 0], v[:, 1]))
    n = len(px)
    ax, ay = acceleration(px, py, vx, vy, string)
    gx = [px[i] + dt * vx[i] for i in range(n)]
    gy = [py[i] + dt * vy[i] for i in range(n)]
    hx = [vx[i] + dt * ax[i] for i in range(n)]
    hy = [vy[i] + dt * ay[i] for i in range(n)]
    bx, by = acceleration(gx, gy, hx, hy, string)
    new_x = [[px[i] + dt / 2 * (vx[i] + hx[i]), py[i] + dt / 2 * (vy[i] + hy[i])] for i in range(n)]
    new_v = [[vx[i] + dt / 2 * (ax[i] + bx[i]), vy[i] + dt / 2 * (ay[i] + by[i])] for i in range(n)]
    return np.array(new_x), np.array(new_v)
