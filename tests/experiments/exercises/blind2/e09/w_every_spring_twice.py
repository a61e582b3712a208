EXERCISE = 9


def springs(rows, columns):
    result = []
    for r in range(rows):
        for c in range(columns):
            for dr, dc in [
                (0, 1),
                (1, 0),
                (0, -1),
                (-1, 0),
                (1, 1),
                (1, -1),
                (-1, 1),
                (-1, -1),
                (2, 0),
                (-2, 0),
                (0, 2),
                (0, -2),
            ]:
                rr, cc = r + dr, c + dc
                if 0 <= rr < rows and 0 <= cc < columns:
                    result.append([r * columns + c, rr * columns + cc])
    return result
