"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

EXERCISE = 9


def springs(rows, columns):
    """Pairs of masses, one for each spring."""
    number = lambda r, c: r * columns + c
    structural = [(number(r, c), number(r, c + 1)) for r in range(rows) for c in range(columns - 1)]
    structural += [(number(r, c), number(r + 1, c)) for r in range(rows - 1) for c in range(columns)]
    shear = [(number(r, c), number(r + 1, c + 1)) for r in range(rows - 1) for c in range(columns - 1)]
    shear += [(number(r, c + 1), number(r + 1, c)) for r in range(rows - 1) for c in range(columns - 1)]
    bend = [(number(r, c), number(r, c + 2)) for r in range(rows) for c in range(columns - 2)]
    bend += [(number(r, c), number(r + 2, c)) for r in range(rows - 2) for c in range(columns - 2)]
    return structural + shear + bend


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
