"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

EXERCISE = 9


def springs(rows, columns):
    """Pairs of masses, one for each spring."""
    s = []
    # structural
    for r in range(rows):
        for c in range(columns - 1):
            s.append((r * columns + c, r * columns + c + 1))
    for r in range(rows - 1):
        for c in range(columns):
            s.append((r * columns + c, (r + 1) * columns + c))
    # shear
    for r in range(rows - 1):
        for c in range(columns - 1):
            s.append((r * columns + c, (r + 1) * columns + c + 1))
            s.append((r * columns + c + 1, (r + 1) * columns + c))
    # bend
    for r in range(rows):
        for c in range(columns - 1):
            s.append((r * columns + c, r * columns + c + 2))
    for r in range(rows - 2):
        for c in range(columns):
            s.append((r * columns + c, (r + 2) * columns + c))
    return s


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
