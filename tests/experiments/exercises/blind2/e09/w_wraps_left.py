EXERCISE = 9


def springs(rows, columns):
    out = set()
    for i in range(rows * columns):
        r, c = divmod(i, columns)
        if c < columns - 1:
            out.add((i, i + 1))
        if r < rows - 1:
            out.add((i, i + columns))
            if c < columns - 1:
                out.add((i, i + columns + 1))
            if c >= 0:
                out.add((i, i + columns - 1))
        if c < columns - 2:
            out.add((i, i + 2))
        if r < rows - 2:
            out.add((i, i + columns * 2))
    return sorted(out)
