EXERCISE = 9


def springs(rows, columns):
    def number(r, c):
        return r * rows + c

    steps = [(0, 1), (1, 0), (1, 1), (1, -1), (0, 2), (2, 0)]
    found = []
    for r in range(rows):
        for c in range(columns):
            for dr, dc in steps:
                if 0 <= r + dr < rows and 0 <= c + dc < columns:
                    found.append((number(r, c), number(r + dr, c + dc)))
    return found
