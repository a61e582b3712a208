"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

EXERCISE = 9


REACH = [(0, 1), (1, 0), (1, 1), (1, -1), (0, 2), (2, 0)]


def springs(rows, columns):
    """Pairs of masses, one for each spring."""
    found = set()
    for n in range(rows * columns):
        r, c = divmod(n, columns)
        for dr, dc in REACH:
            for s in (-1, 1):
                rr, cc = r + s * dr, c + s * dc
                if 0 <= rr < rows and 0 <= cc < columns:
                    found.add(tuple(sorted((n, rr * columns + cc))))
    return sorted(found)


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
