"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

EXERCISE = 9


def springs(rows, columns):
    """Pairs of masses, one for each spring."""
    pairs = []

    def join(r1, c1, r2, c2):
        if r2 < rows and c2 < columns:
            pairs.append([r1 * columns + c1, r2 * columns + c2])

    for r in range(rows):
        for c in range(columns):
            join(r, c, r, c + 1)
            join(r, c, r + 1, c)
            join(r, c, r + 1, c + 1)
            join(r, c, r + 1, c - 1)
            join(r, c, r, c + 2)
            join(r, c, r + 2, c)
    return pairs


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
