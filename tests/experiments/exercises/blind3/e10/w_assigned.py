"""Exercise 10: the bridge. Run me: python bridge.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 10


class Truss:
    def __init__(self, bridge):
        self.b = bridge
        self.nj = len(bridge.joints)
        self.nm = len(bridge.members)

    def unit(self, k):
        p, q = self.b.members[k]
        d = self.b.joints[q] - self.b.joints[p]
        return d / np.linalg.norm(d)

    def forces(self):
        A = np.zeros((2 * self.nj, self.nm + 3))
        for k in range(self.nm):
            p, q = self.b.members[k]
            e = self.unit(k)
            A[2 * p : 2 * p + 2, k] = e
            A[2 * q : 2 * q + 2, k] = -e
        A[2 * self.b.pinned, -3] = 1
        A[2 * self.b.pinned + 1, -2] = 1
        A[2 * self.b.roller + 1, -1] = 1
        rhs = np.zeros(2 * self.nj)
        rhs[1::2] = self.b.masses * self.b.gravity
        return np.linalg.solve(A, rhs)[: self.nm]

    def stiffness(self):
        K = np.zeros((2 * self.nj, 2 * self.nj))
        for k in range(self.nm):
            p, q = self.b.members[k]
            e = self.unit(k)
            block = self.b.stiffness[k] * np.outer(e, e)
            P, Q = slice(2 * p, 2 * p + 2), slice(2 * q, 2 * q + 2)
            K[P, P] = block
            K[Q, Q] = block
            K[P, Q] -= block
            K[Q, P] -= block
        return K


def heaviest(bridge):
    """The number of the member with the largest force, and the force [N], positive in tension."""
    f = Truss(bridge).forces()
    k = int(np.argmax(np.abs(f)))
    return k, float(f[k])


def largest_dt(bridge):
    """The largest stable dt [s] of kick-drift."""
    K = Truss(bridge).stiffness()
    free = [i for i in range(len(K)) if i not in (2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + 1)]
    m = np.repeat(bridge.masses, 2)[free]
    w2 = np.linalg.eigvals(K[free][:, free] / m[:, None])
    return float(2 / np.sqrt(np.max(w2.real)))


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
