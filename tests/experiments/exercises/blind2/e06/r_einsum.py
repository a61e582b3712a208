import numpy as np

EXERCISE = 6


def parts(x, v, p):
    d = np.diff(x, axis=0, prepend=np.atleast_2d(p.anchor))
    w = np.diff(v, axis=0, prepend=np.zeros((1, 2)))
    return d, w, np.sqrt(np.einsum("ij,ij->i", d, d))


def energy(x, v, string):
    _, _, L = parts(x, v, string)
    return np.array(
        [
            np.einsum("i,ij,ij", string.masses, v, v) / 2,
            np.einsum("i,i,i", string.stiffness, L - string.rest_lengths, L - string.rest_lengths) / 2,
            np.einsum("i,i", string.masses, x[:, 1]) * string.gravity,
        ]
    )


def power(x, v, string):
    d, w, L = parts(x, v, string)
    r = np.einsum("ij,ij->i", d, w) / L
    return -np.einsum("i,i,i", string.damping, r, r) - string.drag * np.einsum("ij,ij", v, v)
