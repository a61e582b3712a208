"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

EXERCISE = 9


def springs(rows, columns):
    """Pairs of masses, one for each spring."""

    def m(r, c):
        return r * columns + c

    p = []
    for r in range(rows):
        for c in range(columns):
            if c < columns - 1:
                p.append((m(r, c), m(r, c + 1)))
            if r < rows - 1:
                p.append((m(r, c), m(r + 1, c)))
            if c < columns - 1 and r < rows - 1:
                p.append((m(r, c), m(r + 1, c + 1)))
                p.append((m(r, c + 1), m(r, c)))
            if c < columns - 3:
                p.append((m(r, c), m(r, c + 3)))
            if r < rows - 2:
                p.append((m(r, c), m(r + 2, c)))
    return p


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
