import numpy as np

EXERCISE = 6


class Spring:
    def __init__(self, i, x, v, string):
        top = (string.anchor, np.zeros(2)) if i == 0 else (x[i - 1], v[i - 1])
        self.along = x[i] - top[0]
        self.moves = v[i] - top[1]
        self.k = string.stiffness[i]
        self.c = string.damping[i]
        self.rest = string.rest_lengths[i]

    def length(self):
        return np.sqrt(self.along.dot(self.along))

    def energy(self):
        return self.k / 2 * (self.length() - self.rest) ** 2

    def rate(self):
        return self.along.dot(self.moves) / self.length()

    def loss(self):
        return self.c * self.rate() ** 2


def all_springs(x, v, string):
    return [Spring(i, x, v, string) for i in range(len(x))]


def kinetic(v, string):
    return sum(m * u.dot(u) / 2 for m, u in zip(string.masses, v))


def potential(x, string):
    return sum(m * string.gravity * y for m, y in zip(string.masses, x[:, 1]))


def energy(x, v, string):
    return kinetic(v, string), sum(s.energy() for s in all_springs(x, v, string)), potential(x, string)


def power(x, v, string):
    drag = sum(string.drag * u.dot(u) for u in v)
    return -(sum(s.loss() for s in all_springs(x, v, string)) + drag)
