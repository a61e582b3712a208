"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

from itertools import product

EXERCISE = 9


def springs(rows, columns):
    """Pairs of masses, one for each spring."""
    num = {(r, c): r * columns + c for r, c in product(range(rows), range(columns))}
    structural = [(num[r, c], num[r, c + 1]) for r in range(rows) for c in range(columns - 1)]
    structural += [(num[r, c], num[r + 1, c]) for r in range(rows - 1) for c in range(columns)]
    shear = []
    for r, c in product(range(rows - 1), range(columns - 1)):
        shear += [(num[r, c], num[r + 1, c + 1]), (num[r, c + 1], num[r + 1, c])]
    bend = [(num[r, c], num[r, c + 2]) for r in range(rows) for c in range(columns - 2)]
    bend += [(num[r, c], num[r + 2, c]) for r in range(rows - 3) for c in range(columns)]
    return structural + shear + bend


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
