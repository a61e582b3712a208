import numpy as np

EXERCISE = 4


def rhs(s, p):
    n = len(s) // 4
    x, v = s[: 2 * n].reshape(n, 2), s[2 * n :].reshape(n, 2)
    F = -p.drag * v - np.outer(p.masses, [0.0, p.gravity])
    for i in range(n):
        d = x[i] - (x[i - 1] if i else p.anchor)
        L = np.hypot(*d)
        t = p.stiffness[i] * (L - p.rest_lengths[i]) * d / L
        F[i] -= t
        if i:
            F[i - 1] += t
    return np.r_[v.ravel(), (F / p.masses[:, None]).ravel()]


def step(x, v, dt, string):
    s = np.concatenate([x.ravel(), v.ravel()])
    k1 = rhs(s, string)
    k2 = rhs(s + dt * k1, string)
    s = s + dt * (k1 + k2) / 2
    return s[: x.size].reshape(x.shape), s[x.size :].reshape(x.shape)
