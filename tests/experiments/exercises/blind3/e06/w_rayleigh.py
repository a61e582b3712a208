"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


class Link:
    def __init__(self, a, b, va, vb):
        self.d = b - a
        self.length = float(np.linalg.norm(self.d))
        self.rate = float((vb - va) @ self.d) / self.length


def links(x, v, string):
    a, va = string.anchor, np.zeros(2)
    for b, vb in zip(x, v):
        yield Link(a, b, va, vb)
        a, va = b, vb


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    kinetic = sum(0.5 * m * (u @ u) for m, u in zip(string.masses, v))
    elastic = sum(
        0.5 * k * (link.length - r) ** 2
        for k, r, link in zip(string.stiffness, string.rest_lengths, links(x, v, string))
    )
    weight = sum(m * string.gravity * p[1] for m, p in zip(string.masses, x))
    return kinetic, elastic, weight


def power(x, v, string):
    """What damping adds to the energy [W]."""
    springs = sum(0.5 * c * link.rate**2 for c, link in zip(string.damping, links(x, v, string)))
    air = sum(string.drag * (u @ u) for u in v)
    return -(springs + air)


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
