"""Exercise 10: the bridge. Run me: python bridge.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 10


class Truss:
    def __init__(self, bridge):
        self.b = bridge
        self.n = bridge.joints.shape[0]
        self.m = bridge.members.shape[0]
        self.dirs = []
        for p, q in bridge.members:
            dx, dy = bridge.joints[q] - bridge.joints[p]
            length = np.hypot(dx, dy)
            self.dirs.append((dx / length, dy / length))

    def equations(self):
        """Sums of forces at joints: first all sideways, then all upwards."""
        b, n, m = self.b, self.n, self.m
        A = np.zeros((2 * n, m + 3))
        for i in range(m):
            p, q = b.members[i]
            c, s = self.dirs[i]
            A[p, i], A[n + p, i] = c, s
            A[q, i], A[n + q, i] = -c, -s
        A[b.pinned, m] = 1
        A[n + b.pinned, m + 1] = 1
        A[n + b.roller, m + 2] = 1
        return A, np.concatenate([np.zeros(n), b.masses * b.gravity])

    def stiffness(self):
        b, n = self.b, self.n
        K = np.zeros((2 * n, 2 * n))
        for i in range(self.m):
            p, q = b.members[i]
            c, s = self.dirs[i]
            g = np.zeros(2 * n)
            g[p], g[n + p], g[q], g[n + q] = c, s, -c, -s
            K += b.stiffness[i] * np.outer(g, g)
        return K


def heaviest(bridge):
    """The number of the member with the largest force, and the force [N], positive in tension."""
    t = Truss(bridge)
    A, w = t.equations()
    forces = np.linalg.solve(A, w)[: t.m]
    order = np.argsort(np.abs(forces))
    return order[-1], forces[order[-1]]


def largest_dt(bridge):
    """The largest stable dt [s] of kick-drift."""
    t = Truss(bridge)
    D = t.stiffness() / np.concatenate([bridge.masses, bridge.masses])[:, None]
    free = np.ones(2 * t.n, dtype=bool)
    free[[bridge.roller, t.n + bridge.roller, t.n + bridge.pinned]] = False
    D = D[free][:, free]
    fastest = np.sqrt(np.max(np.linalg.eigvals(D).real))
    return 2 / fastest


if __name__ == "__main__":
    bridge = SimpleNamespace(
        joints=np.array([[0.0, 0.0], [3.0, 0.0], [6.0, 0.0], [1.5, 3.0], [4.5, 3.0]]),
        members=np.array([[0, 1], [1, 2], [3, 4], [0, 3], [2, 4], [1, 3], [1, 4]]),
        stiffness=np.full(7, 2e7),
        masses=np.full(5, 1000.0),
        gravity=9.81,
        pinned=0,
        roller=2,
    )
    print(heaviest(bridge), largest_dt(bridge))
