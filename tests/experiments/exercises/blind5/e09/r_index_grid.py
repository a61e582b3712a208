"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

import numpy as np

EXERCISE = 9


def springs(rows, columns):
    """Pairs of masses, one for each spring."""
    grid = np.arange(rows * columns).reshape(rows, columns)
    couples = [
        (grid[:, :-1], grid[:, 1:]),
        (grid[:-1, :], grid[1:, :]),
        (grid[:-1, :-1], grid[1:, 1:]),
        (grid[1:, :-1], grid[:-1, 1:]),
        (grid[:, :-2], grid[:, 2:]),
        (grid[:-2, :], grid[2:, :]),
    ]
    return np.concatenate([np.stack([a.ravel(), b.ravel()], axis=1) for a, b in couples])


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
