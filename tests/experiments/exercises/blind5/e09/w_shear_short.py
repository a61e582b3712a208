"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

import numpy as np

EXERCISE = 9


def springs(rows, columns):
    """Pairs of masses, one for each spring."""
    N = np.arange(rows * columns).reshape((rows, columns))
    out = []
    for row in N:
        out += list(zip(row, row[1:]))
        out += list(zip(row, row[2:]))
    for col in N.T:
        out += list(zip(col, col[1:]))
        out += list(zip(col, col[2:]))
    for r in range(rows - 1):
        for c in range(columns - 2):
            out.append((N[r, c], N[r + 1, c + 1]))
            out.append((N[r, c + 1], N[r + 1, c]))
    return out


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
