"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

EXERCISE = 9

STRUCTURAL = [(0, 1), (1, 0), (0, -1), (-1, 0)]
SHEAR = [(1, 1), (1, -1), (-1, 1), (-1, -1)]
BEND = [(0, 2), (2, 0), (0, -2), (-2, 0)]


def springs(rows, columns):
    """Pairs of masses, one for each spring."""
    result = []
    for r in range(rows):
        for c in range(columns):
            for dr, dc in STRUCTURAL + SHEAR + BEND:
                r2, c2 = r + dr, c + dc
                if 0 <= r2 < rows and 0 <= c2 < columns:
                    result.append((r * columns + c, r2 * columns + c2))
    return result


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
