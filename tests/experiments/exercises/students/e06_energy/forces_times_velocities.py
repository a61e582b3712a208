import numpy as np

EXERCISE = 6


def energy(x, v, string):
    z = np.concatenate(([complex(*string.anchor)], x @ [1, 1j]))
    stretch = np.abs(z[1:] - z[:-1]) - string.rest_lengths
    return np.array(
        [
            np.einsum("i,ij,ij->", string.masses, v, v) / 2,
            string.stiffness @ stretch**2 / 2,
            string.gravity * (string.masses @ x[:, 1]),
        ]
    )


def power(x, v, string):
    # the damping forces on every mass, times its velocity
    force = -string.drag * v
    for i in range(len(x)):
        d = x[i] - (x[i - 1] if i else string.anchor)
        u = d / np.hypot(*d)
        f = string.damping[i] * ((v[i] - (v[i - 1] if i else 0)) @ u) * u
        force[i] -= f
        if i:
            force[i - 1] += f
    return (force * v).sum()
