"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

EXERCISE = 9


def springs(rows, columns):
    """Pairs of masses, one for each spring."""
    n = rows * columns
    out = []
    for i in range(n - 1):
        out.append((i, i + 1))
    for i in range(n - columns):
        out.append((i, i + columns))
        if i % columns != columns - 1:
            out.append((i, i + columns + 1))
        if i % columns != 0:
            out.append((i, i + columns - 1))
    for i in range(n):
        if i % columns < columns - 2:
            out.append((i, i + 2))
        if i + 2 * columns < n:
            out.append((i, i + 2 * columns))
    return out


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
