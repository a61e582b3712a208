"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

EXERCISE = 9


def springs(rows, columns):
    """Pairs of masses, one for each spring."""
    pairs = []
    for r in range(rows):
        for c in range(columns):
            me = r * columns + c
            if c + 1 < columns:
                pairs.append((me, me + 1))
            if r + 1 < rows:
                pairs.append((me, me + columns))
            if r + 1 < rows and c + 1 < columns:
                pairs.append((me, me + columns + 1))
            if c + 2 < columns:
                pairs.append((me, me + 2))
            if r + 2 < rows:
                pairs.append((me, me + 2 * columns))
    return pairs


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
