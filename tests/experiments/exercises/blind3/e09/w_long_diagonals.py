"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

EXERCISE = 9


def springs(rows, columns):
    """Pairs of masses, one for each spring."""
    offsets = [(0, 1), (1, 0), (1, 1), (1, -1)]
    offsets += [(0, 2), (2, 0), (2, 2), (2, -2)]
    result = []
    for dr, dc in offsets:
        for r in range(rows - dr):
            for c in range(max(0, -dc), min(columns, columns - dc)):
                i = r * columns + c
                j = (r + dr) * columns + (c + dc)
                result.append((i, j))
    return result


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
