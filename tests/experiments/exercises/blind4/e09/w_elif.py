"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

EXERCISE = 9


def springs(rows, columns):
    """Pairs of masses, one for each spring."""
    result = []
    for i in range(rows):
        for j in range(columns):
            me = i * columns + j
            right = j < columns - 1
            down = i < rows - 1
            if right:
                result.append((me, me + 1))
            if down:
                result.append((me, me + columns))
            if right and down:
                result.append((me, me + columns + 1))
                result.append((me + 1, me + columns))
            if j < columns - 2:
                result.append((me, me + 2))
            elif i < rows - 2:
                result.append((me, me + 2 * columns))
    return result


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
