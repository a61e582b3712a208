import numpy as np

EXERCISE = 4


def forces(x, v, s):
    up = np.vstack([s.anchor, x[:-1]]) - x
    length = np.hypot(up[:, 0], up[:, 1])
    pull = (s.stiffness * (1 - s.rest_lengths / length))[:, None] * up
    f = pull - s.drag * v
    f[:-1] -= pull[1:]
    f[:, 1] -= s.masses * s.gravity
    return f


def step(x, v, dt, s):
    gx, gv = x.copy(), v.copy()
    a = forces(x, v, s) / s.masses[:, None]
    gx += dt * v
    gv += dt * a
    b = forces(gx, gv, s) / s.masses[:, None]
    nx, nv = x.copy(), v.copy()
    nx += dt / 2 * v
    nx += dt / 2 * gv
    nv += dt / 2 * a
    nv += dt / 2 * b
    return nx, nv
