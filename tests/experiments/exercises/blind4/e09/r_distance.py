"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

from itertools import combinations

EXERCISE = 9


def springs(rows, columns):
    """Pairs of masses, one for each spring."""
    pairs = []
    for a, b in combinations(range(rows * columns), 2):
        dr = a // columns - b // columns
        dc = a % columns - b % columns
        # 1: neighbour, 2: diagonal, 4: next but one
        if dr * dr + dc * dc in (1, 2, 4):
            pairs.append((b, a))
    return pairs


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
