"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

EXERCISE = 9


def springs(rows, columns):
    """Pairs of masses, one for each spring."""
    pairs = []
    # structural
    for r in range(rows):
        for c in range(columns - 1):
            pairs.append((r * columns + c, r * columns + c + 1))
    for r in range(rows - 1):
        for c in range(columns):
            pairs.append((r * columns + c, (r + 1) * columns + c))
    # shear
    for r in range(rows - 1):
        for c in range(columns - 1):
            pairs.append((r * columns + c, (r + 1) * columns + c + 1))
    # bend
    for r in range(rows):
        for c in range(columns - 2):
            pairs.append((r * columns + c, r * columns + c + 2))
    for r in range(rows - 2):
        for c in range(columns):
            pairs.append((r * columns + c, (r + 2) * columns + c))
    return pairs


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
