import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    z = (x[:, 0] - circle.centre[0]) + 1j * (x[:, 1] - circle.centre[1])
    u = v[:, 0] + 1j * v[:, 1]
    n = z / abs(z)
    inside = abs(z) < circle.radius
    radial = (u * n.conj()).real.clip(max=0) * inside
    u = u - radial * n
    z = np.where(inside, circle.radius * n, z)
    X = np.stack([z.real, z.imag], axis=1) + circle.centre
    X[~inside] = x[~inside]
    return X, np.stack([u.real, u.imag], axis=1)
