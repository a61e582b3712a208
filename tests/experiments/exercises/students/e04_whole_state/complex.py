import numpy as np

EXERCISE = 4


def step(x, v, dt, s):
    z, w = x[:, 0] + 1j * x[:, 1], v[:, 0] + 1j * v[:, 1]
    anchor = complex(*s.anchor)

    def a(z, w):
        gap = np.concatenate([[anchor], z[:-1]]) - z
        T = s.stiffness * (abs(gap) - s.rest_lengths) * gap / abs(gap)
        return (T - np.append(T[1:], 0) - s.drag * w) / s.masses - 1j * s.gravity

    k = a(z, w)
    l = a(z + dt * w, w + dt * k)
    z, w = z + dt * (w + w + dt * k) / 2, w + dt * (k + l) / 2
    return np.stack([z.real, z.imag], 1), np.stack([w.real, w.imag], 1)
