EXERCISE = 9


def springs(rows, columns):
    pairs = []
    for r in range(rows):
        for c in range(columns):
            for dr, dc in [(0, 1), (1, 0), (1, 1), (1, -1), (0, 2), (2, 0)]:
                if r + dr < rows and 0 <= c + dc < columns:
                    pairs.append((r * columns + c, (r + dr) * columns + c + dc))
    return pairs
