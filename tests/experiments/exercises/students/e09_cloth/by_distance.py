from itertools import combinations

EXERCISE = 9


def springs(rows, columns):
    """All pairs of masses; those that are 1, root of 2 or 2 apart are joined."""
    places = [(r, c) for r in range(rows) for c in range(columns)]
    found = set()
    for (i, a), (j, b) in combinations(enumerate(places), 2):
        if (a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2 in (1, 2, 4):
            found.add((max(i, j), min(i, j)))
    return found
