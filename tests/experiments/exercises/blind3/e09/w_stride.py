"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

EXERCISE = 9


def springs(rows, columns):
    num = lambda r, c: r * rows + c
    out = []
    for r in range(rows):
        out += [(num(r, c), num(r, c + 1)) for c in range(columns - 1)]
        out += [(num(r, c), num(r, c + 2)) for c in range(columns - 2)]
    for c in range(columns):
        out += [(num(r, c), num(r + 1, c)) for r in range(rows - 1)]
        out += [(num(r, c), num(r + 2, c)) for r in range(rows - 2)]
    for r in range(rows - 1):
        for c in range(columns - 1):
            out += [(num(r, c), num(r + 1, c + 1)), (num(r, c + 1), num(r + 1, c))]
    return out


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
