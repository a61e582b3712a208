"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

EXERCISE = 9


def springs(rows, columns):
    """Pairs of masses, one for each spring."""

    def number(r, c):
        return r * rows + c

    s = []
    for r in range(rows):
        for c in range(columns):
            if c + 1 < columns:
                s.append((number(r, c), number(r, c + 1)))
            if r + 1 < rows:
                s.append((number(r, c), number(r + 1, c)))
            if r + 1 < rows and c + 1 < columns:
                s.append((number(r, c), number(r + 1, c + 1)))
                s.append((number(r + 1, c), number(r, c + 1)))
            if c + 2 < columns:
                s.append((number(r, c), number(r, c + 2)))
            if r + 2 < rows:
                s.append((number(r, c), number(r + 2, c)))
    return s


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
