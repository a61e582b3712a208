"""Exercise 3: the forces on a string. Run me: python forces.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 3


class Link:
    def __init__(self, k, rest):
        self.k, self.rest = k, rest

    def pull(self, p, q):
        d = q - p
        r = np.linalg.norm(d)
        return self.k * (r - self.rest) / r * d


def forces(x, v, string):
    """The force on every mass [N], shape (n, 2)."""
    links = [Link(k, r) for k, r in zip(string.stiffness, string.rest_lengths)]
    f = np.array([[0, -m * string.gravity] for m in string.masses]) - string.drag * v
    f[0] += links[0].pull(x[0], string.anchor)
    for i in range(1, len(links) - 1):
        p = links[i].pull(x[i], x[i - 1])
        f[i] += p
        f[i - 1] -= p
    return f


if __name__ == "__main__":
    string = SimpleNamespace(
        masses=np.full(3, 0.05),
        stiffness=np.full(3, 50.0),
        rest_lengths=np.full(3, 0.15),
        drag=0.02,
        gravity=9.81,
        anchor=np.array([0.1, 0.2]),
    )
    x = string.anchor + np.array([[0.15, 0.0], [0.3, 0.0], [0.45, 0.0]])
    v = np.zeros((3, 2))
    print(forces(x, v, string))
