import numpy as np

EXERCISE = 4


class Rope:
    """The state is one flat array: all velocities first, then all positions."""

    def __init__(self, string):
        self.s = string
        self.n = len(string.masses)
        # each spring with its two ends; -1 is the anchor
        self.springs = [(i - 1, i, string.stiffness[i], string.rest_lengths[i]) for i in range(self.n)]

    def place(self, r, i):
        return np.array(self.s.anchor) if i == -1 else r[i]

    def rate(self, y):
        u, r = y.reshape(2, self.n, 2)
        F = np.zeros((self.n, 2))
        for upper, lower, k, l0 in self.springs:
            d = self.place(r, upper) - r[lower]
            norm = np.hypot(d[0], d[1])
            e = d / norm
            T = k * (norm - l0)
            F[lower] += T * e
            if upper >= 0:
                F[upper] -= T * e
        F[:, 1] -= self.s.masses * self.s.gravity
        F -= self.s.drag * u
        return np.concatenate([(F / self.s.masses.reshape(-1, 1)).ravel(), u.ravel()])

    def heun(self, y, h):
        k1 = self.rate(y)
        guess = y + h * k1
        k2 = self.rate(guess)
        return y + h * 0.5 * (k1 + k2)


def step(x, v, dt, string):
    rope = Rope(string)
    y = rope.heun(np.concatenate([v.ravel(), x.ravel()]), dt)
    u, r = y.reshape(2, rope.n, 2)
    return r, u
