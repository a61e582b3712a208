"""Exercise 7: the barrier. Run me: python barrier.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 7


class Barrier:
    def __init__(self, circle):
        self.c = circle.centre
        self.r = circle.radius

    def contains(self, p):
        return np.linalg.norm(p - self.c) < self.r

    def normal(self, p):
        return (p - self.c) / np.linalg.norm(p - self.c)

    def apply(self, p, u):
        if not self.contains(p):
            return p, u
        n = self.normal(p)
        if n @ u < 0:
            u = np.zeros(2)
        return self.c + n * self.r, u


def push_out(x, v, circle):
    """Positions x [m] and velocities v [m/s], shape (n, 2), after they have met the circle."""
    barrier = Barrier(circle)
    pairs = [barrier.apply(p, u) for p, u in zip(x, v)]
    return np.array([p for p, _ in pairs]), np.array([u for _, u in pairs])


if __name__ == "__main__":
    circle = SimpleNamespace(centre=np.array([0.5, 0.0]), radius=0.3)
    x = np.array([[0.5, 0.25], [0.3, 0.0], [0.0, 0.0]])
    v = np.array([[0.5, -1.0], [0.5, -1.0], [0.5, -1.0]])
    print(*push_out(x, v, circle), sep="\n")
