"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


class Spring:
    def __init__(self, i, x, v, string):
        upper_x = x[i - 1] if i > 0 else string.anchor
        upper_v = v[i - 1] if i > 0 else np.zeros(2)
        self.vector = x[i] - upper_x
        self.length = np.linalg.norm(self.vector)
        self.rate = (v[i] - upper_v) @ self.vector / self.length
        self.k = string.stiffness[i]
        self.c = string.damping[i]
        self.rest = string.rest_lengths[i]

    def energy(self):
        return self.k * (self.length - self.rest) ** 2 / 2

    def loss(self):
        return self.c * self.rate ** 2


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    springs = [Spring(i, x, v, string) for i in range(len(x))]
    kinetic = (string.masses / 2 * (v[:, 0] ** 2 + v[:, 1] ** 2)).sum()
    return kinetic, sum(s.energy() for s in springs), (string.masses * x[:, 1]).sum() * string.gravity


def power(x, v, string):
    """What damping adds to the energy [W]."""
    springs = [Spring(i, x, v, string) for i in range(len(x))]
    return sum(s.loss() for s in springs) + string.drag * (v ** 2).sum()


if __name__ == "__main__":
    string = SimpleNamespace(
        masses=np.full(3, 0.05),
        stiffness=np.full(3, 50.0),
        rest_lengths=np.full(3, 0.15),
        damping=np.full(3, 0.05),
        drag=0.02,
        gravity=9.81,
        anchor=np.array([0.1, 0.2]),
    )
    x = string.anchor + np.array([[0.15, 0.0], [0.3, 0.0], [0.45, 0.0]])
    v = np.zeros((3, 2))
    v[:, 1] = -1.0
    print(energy(x, v, string), power(x, v, string))
