"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

import numpy as np

EXERCISE = 9


def springs(rows, columns):
    """Pairs of masses, one for each spring."""
    ids = np.arange(rows * columns).reshape(rows, columns)

    def join(a, b):
        return np.column_stack((a.ravel(), b.ravel()))

    return np.concatenate(
        [
            join(ids[:-1, :-1], ids[:-1, 1:]),
            join(ids[:-1, :], ids[1:, :]),
            join(ids[:-1, :-1], ids[1:, 1:]),
            join(ids[:-1, 1:], ids[1:, :-1]),
            join(ids[:, :-2], ids[:, 2:]),
            join(ids[:-2, :], ids[2:, :]),
        ]
    )


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
