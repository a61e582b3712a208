import numpy as np

EXERCISE = 4


def forces(x, v, string):
    F = np.zeros(x.shape)
    for i in range(len(x)):
        a = string.anchor if i == 0 else x[i - 1]
        d = a - x[i]
        L = np.linalg.norm(d)
        f = string.stiffness[i] * (L - string.rest_lengths[i]) / L * d
        F[i] += f
        if i:
            F[i - 1] -= f
        F[i, 1] -= string.masses[i] * string.gravity
        F[i] -= string.drag * v[i]
    return F


def step(x, v, dt, string):
    def accel(x, v):
        return forces(x, v, string) / string.masses[:, None] - np.array([0, string.gravity])

    a = accel(x, v)
    v_guess = v + a * dt
    x_guess = x + v * dt
    b = accel(x_guess, v_guess)
    return x + 0.5 * dt * (v + v_guess), v + 0.5 * dt * (a + b)
