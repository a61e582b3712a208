"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

import numpy as np

EXERCISE = 9


def springs(rows, columns):
    """Pairs of masses, one for each spring."""
    k = np.arange(rows * columns)
    r, c = k // columns, k % columns
    parts = []
    for jump, ok in (
        (1, c >= 1),
        (2, c >= 2),
        (columns, r >= 1),
        (2 * columns, r >= 2),
        (columns + 1, (r >= 1) & (c >= 1)),
        (columns - 1, (r >= 1) & (c < columns - 1)),
    ):
        parts.append(np.array([k[ok], k[ok] - jump]).T)
    return np.vstack(parts)


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
