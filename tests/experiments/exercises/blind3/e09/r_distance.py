"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

EXERCISE = 9

from itertools import combinations


def springs(rows, columns):
    """Pairs of masses, one for each spring."""
    pairs = []
    for i, j in combinations(range(rows * columns), 2):
        r, c = divmod(i, columns)
        p, q = divmod(j, columns)
        if (r - p) ** 2 + (c - q) ** 2 in (1, 2, 4):
            pairs.append((i, j))
    return pairs


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
