"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

EXERCISE = 9


def springs(rows, columns):
    """Pairs of masses, one for each spring."""
    pairs = []

    def add(a, b):
        pairs.append([a, b])

    for r in range(rows):
        for c in range(columns):
            i = r * columns + c
            if c < columns - 1:
                add(i, i + 1)
            if c < columns - 2:
                add(i, i + 2)
            if r < rows - 1:
                below = i + columns
                add(i, below)
                if c < columns - 1:
                    add(i, below + 1)
                add(i, below - 1)
    return pairs


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
