"""Exercise 3: the forces on a string. Run me: python forces.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 3


class Spring:
    def __init__(self, k, rest):
        self.k, self.rest = k, rest

    def pull(self, lower, upper):
        """Force on the lower mass."""
        d = upper - lower
        l = np.linalg.norm(d)
        return self.k * (l - self.rest) / l * d


def forces(x, v, string):
    """The force on every mass [N], shape (n, 2)."""
    links = [Spring(k, r) for k, r in zip(string.stiffness, string.rest_lengths)]
    result = np.zeros_like(x)
    for i, link in enumerate(links):
        upper = x[i - 1] if i else string.anchor
        p = link.pull(x[i], upper)
        result[i] += p
        if i:
            result[i - 1] += p
    result[:, 1] -= string.masses * string.gravity
    result -= string.drag * v
    return result


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
