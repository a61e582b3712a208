"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

EXERCISE = 9


def springs(rows, columns):
    """Pairs of masses, one for each spring."""
    n = rows * columns
    s = set()
    for i in range(n):
        column = i % columns
        # structural
        if i + 1 < n:
            s.add((i, i + 1))
        if i + columns < n:
            s.add((i, i + columns))
        # shear
        if column < columns - 1 and i + columns < n:
            s.add((i, i + columns + 1))
            s.add((i + 1, i + columns))
        # bend
        if column < columns - 2:
            s.add((i, i + 2))
        if i + 2 * columns < n:
            s.add((i, i + 2 * columns))
    return sorted(s)


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
