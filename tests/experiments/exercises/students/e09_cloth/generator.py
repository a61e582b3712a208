import numpy as np

EXERCISE = 9


def springs(rows, columns):
    ways = np.array([[0, 1], [1, 0], [1, 1], [-1, 1], [0, 2], [2, 0]])
    r, c = np.divmod(np.arange(rows * columns), columns)
    lists = []
    for dr, dc in ways:
        ok = (r + dr >= 0) & (r + dr < rows) & (c + dc < columns)
        i = np.flatnonzero(ok)
        lists.append(np.c_[i + dr * columns + dc, i])
    np.random.default_rng(3).shuffle(lists[0])
    return np.vstack(lists).astype(np.uint16)
