EXERCISE = 9


def springs(rows, columns):
    n = lambda r, c: r * columns + c
    s = []
    s += [(n(r, c), n(r, c + 1)) for r in range(rows) for c in range(columns - 1)]
    s += [(n(r, c), n(r + 1, c)) for r in range(rows - 1) for c in range(columns)]
    s += [(n(r, c), n(r + 1, c + 1)) for r in range(rows - 1) for c in range(columns - 1)]
    s += [(n(r, c + 1), n(r + 1, c)) for r in range(rows - 1) for c in range(columns - 1)]
    s += [(n(r, c), n(r, c + 2)) for r in range(rows) for c in range(columns - 2)]
    s += [(n(r, c), n(r + 2, c)) for r in range(rows - 3) for c in range(columns)]
    return s
