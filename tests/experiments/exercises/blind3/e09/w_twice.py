"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

EXERCISE = 9

NEIGHBOURS = [
    (0, 1),
    (1, 0),
    (0, -1),
    (-1, 0),
    (1, 1),
    (1, -1),
    (-1, 1),
    (-1, -1),
    (0, 2),
    (2, 0),
    (0, -2),
    (-2, 0),
]


def springs(rows, columns):
    """Pairs of masses, one for each spring."""
    return [
        (r * columns + c, (r + dr) * columns + c + dc)
        for r in range(rows)
        for c in range(columns)
        for dr, dc in NEIGHBOURS
        if 0 <= r + dr < rows and 0 <= c + dc < columns
    ]


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
