EXERCISE = 9


def springs(rows, columns):
    pairs = []
    for r in range(rows):
        for c in range(columns):
            i = r * columns + c
            if c + 1 < columns:
                pairs.append((i, i + 1))
            if r + 1 < rows:
                pairs.append((i, i + columns))
            if r + 1 < rows and c + 1 < columns:
                pairs.append((i, i + columns + 1))
            if c + 2 < columns:
                pairs.append((i, i + 2))
            if r + 2 < rows:
                pairs.append((i, i + 2 * columns))
    return pairs
