"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

EXERCISE = 9


def springs(rows, columns):
    """Pairs of masses, one for each spring."""
    grid = {(r, c): r * columns + c for r in range(rows) for c in range(columns)}
    found = set()
    for (r, c), i in grid.items():
        around = [(r + a, c + b) for a in (-1, 0, 1) for b in (-1, 0, 1) if a or b]
        around += [(r + 2, c), (r - 2, c), (r, c + 2), (r, c - 2)]
        for place in around:
            j = grid.get(place)
            if j is not None:
                found.add((min(i, j), max(i, j)))
    return sorted(found)


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
