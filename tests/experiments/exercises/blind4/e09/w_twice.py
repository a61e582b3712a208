"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

EXERCISE = 9


def springs(rows, columns):
    """Pairs of masses, one for each spring."""
    offsets = [(0, 1), (0, -1), (1, 0), (1, 1), (1, -1), (0, 2), (2, 0)]
    pairs = []
    for r in range(rows):
        for c in range(columns):
            for dr, dc in offsets:
                r2 = r + dr
                c2 = c + dc
                if r2 >= rows or c2 >= columns or c2 < 0:
                    continue
                pairs.append((r * columns + c, r2 * columns + c2))
    return pairs


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
