"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

EXERCISE = 9


class Cloth:
    def __init__(self, rows, columns):
        self.rows, self.columns = rows, columns
        self.list = []

    def add(self, r, c, dr, dc):
        a = r * self.columns + c
        self.list.append((a, a + dr * self.columns + dc))

    def structural(self):
        for r in range(self.rows):
            for c in range(self.rows - 1):
                self.add(r, c, 0, 1)
        for r in range(self.rows - 1):
            for c in range(self.columns):
                self.add(r, c, 1, 0)

    def shear(self):
        for r in range(self.rows - 1):
            for c in range(self.columns - 1):
                self.add(r, c, 1, 1)
                self.add(r, c + 1, 1, -1)

    def bend(self):
        for r in range(self.rows):
            for c in range(2, self.columns):
                self.add(r, c, 0, -2)
        for r in range(2, self.rows):
            for c in range(self.columns):
                self.add(r, c, -2, 0)


def springs(rows, columns):
    """Pairs of masses, one for each spring."""
    cloth = Cloth(rows, columns)
    cloth.structural()
    cloth.shear()
    cloth.bend()
    return cloth.list


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
