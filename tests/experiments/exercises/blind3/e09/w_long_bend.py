"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

import numpy as np

EXERCISE = 9


def springs(rows, columns):
    """Pairs of masses, one for each spring."""
    n = np.arange(rows * columns).reshape((rows, columns))
    pairs = []
    pairs += zip(n[:, :-1].flat, n[:, 1:].flat)
    pairs += zip(n[:-1].flat, n[1:].flat)
    pairs += zip(n[:-1, :-1].flat, n[1:, 1:].flat)
    pairs += zip(n[1:, :-1].flat, n[:-1, 1:].flat)
    pairs += zip(n[:, :-3].flat, n[:, 3:].flat)
    return [(int(a), int(b)) for a, b in pairs]


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
