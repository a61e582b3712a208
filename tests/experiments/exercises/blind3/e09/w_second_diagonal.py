"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

EXERCISE = 9


class Cloth:
    def __init__(self, rows, columns):
        self.rows, self.columns = rows, columns
        self.pairs = []

    def index(self, r, c):
        return r * self.columns + c

    def add(self, r1, c1, r2, c2):
        self.pairs.append((self.index(r1, c1), self.index(r2, c2)))

    def structural(self):
        for r in range(self.rows):
            for c in range(self.columns):
                if r > 0:
                    self.add(r - 1, c, r, c)
                if c > 0:
                    self.add(r, c - 1, r, c)

    def shear(self):
        for r in range(self.rows - 1):
            for c in range(self.columns - 1):
                self.add(r, c, r + 1, c + 1)
            for c in range(self.columns):
                self.add(r, c, r + 1, c - 1)

    def bend(self):
        for r in range(self.rows):
            for c in range(self.columns):
                if r > 1:
                    self.add(r - 2, c, r, c)
                if c > 1:
                    self.add(r, c - 2, r, c)


def springs(rows, columns):
    """Pairs of masses, one for each spring."""
    cloth = Cloth(rows, columns)
    cloth.structural()
    cloth.shear()
    cloth.bend()
    return cloth.pairs


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
