"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

import numpy as np

EXERCISE = 9


def springs(rows, columns):
    """Pairs of masses, one for each spring."""
    index = np.arange(rows * columns).reshape((rows, columns))
    kinds = {"structural": [(0, 1), (1, 0)], "shear": [(1, 1)], "bend": [(0, 2), (2, 0), (2, 2)]}
    result = []
    for shifts in kinds.values():
        for dr, dc in shifts:
            a = index[: rows - dr, : columns - dc] if rows > dr and columns > dc else index[:0]
            b = index[dr:, dc:]
            result += list(zip(a.flatten().tolist(), b.flatten().tolist()))
    # other diagonal
    result += list(zip(index[:-1, 1:].flatten().tolist(), index[1:, :-1].flatten().tolist()))
    return result


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
