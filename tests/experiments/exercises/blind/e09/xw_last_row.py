EXERCISE = 9


def springs(rows, columns):
    s = []
    for r in range(rows - 1):
        for c in range(columns):
            i = r * columns + c
            if c < columns - 1:
                s.append((i, i + 1))
            if r < rows - 1:
                s.append((i, i + columns))
            if r < rows - 1 and c < columns - 1:
                s.append((i, i + columns + 1))
            if r < rows - 1 and c > 0:
                s.append((i, i + columns - 1))
            if c < columns - 2:
                s.append((i, i + 2))
            if r < rows - 2:
                s.append((i, i + 2 * columns))
    return s
