"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

import numpy as np

EXERCISE = 9


def springs(rows, columns):
    """Pairs of masses, one for each spring."""
    g = np.arange(rows * columns).reshape(rows, columns)
    pieces = [
        (g[:, :-1], g[:, 1:]),
        (g[:-1, :], g[1:, :]),  # structural
        (g[:-1, :-1], g[1:, 1:]),
        (g[:-1, 1:], g[1:, :-1]),  # shear
        (g[:, :-2], g[:, 2:]),
        (g[:-2, :], g[2:, :]),  # bend
    ]
    return np.vstack([np.stack([a.ravel(), b.ravel()], axis=1) for a, b in pieces])


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
