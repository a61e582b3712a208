"""Exercise 9: the springs of a cloth. Run me: python cloth.py."""

EXERCISE = 9


class Cloth:
    def __init__(self, rows, columns):
        self.rows, self.columns = rows, columns
        self.pairs = []

    def index(self, r, c):
        return r * self.rows + c

    def exists(self, r, c):
        return 0 <= r < self.rows and 0 <= c < self.columns

    def join(self, r, c, dr, dc):
        if self.exists(r + dr, c + dc):
            self.pairs.append((self.index(r, c), self.index(r + dr, c + dc)))

    def build(self):
        for r in range(self.rows):
            for c in range(self.columns):
                self.join(r, c, 0, 1)
                self.join(r, c, 1, 0)
                self.join(r, c, 1, 1)
                self.join(r, c, 1, -1)
                self.join(r, c, 0, 2)
                self.join(r, c, 2, 0)
        return self.pairs


def springs(rows, columns):
    """Pairs of masses, one for each spring."""
    return Cloth(rows, columns).build()


if __name__ == "__main__":
    pairs = springs(3, 4)
    print(len(pairs), "springs:", pairs)
