"""Exercise 10: the bridge. Run me: python bridge.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 10


def geometry(bridge):
    a = bridge.members[:, 0]
    b = bridge.members[:, 1]
    d = bridge.joints[b] - bridge.joints[a]
    return a, b, d / np.linalg.norm(d, axis=1)[:, None]


def heaviest(bridge):
    """The number of the member with the largest force, and the force [N], positive in tension."""
    a, b, e = geometry(bridge)
    j, m = len(bridge.joints), len(bridge.members)
    A = np.zeros((2 * j, 2 * j))
    for i in range(m):
        for c in range(2):
            A[2 * a[i] + c, i] += e[i, c]
            A[2 * b[i] + c, i] -= e[i, c]
    for column, row in enumerate([2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + 1]):
        A[row, m + column] = 1
    rhs = np.zeros(2 * j)
    rhs[1::2] = bridge.masses * bridge.gravity
    f = np.linalg.solve(A, rhs)[:m]
    i = np.abs(f).argmax()
    return int(i), f[i]


def largest_dt(bridge):
    """The largest stable dt [s] of kick-drift."""
    a, b, e = geometry(bridge)
    j = len(bridge.joints)
    K = np.zeros((2 * j, 2 * j))
    for i, k in enumerate(bridge.stiffness):
        g = np.zeros(2 * j)
        g[2 * a[i]:2 * a[i] + 2] = -e[i]
        g[2 * b[i]:2 * b[i] + 2] = e[i]
        K += k * np.outer(g, g)
    mass = np.repeat(bridge.masses, 2)
    fixed = [2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller, 2 * bridge.roller + 1]
    K = np.delete(np.delete(K, fixed, axis=0), fixed, axis=1)
    mass = np.delete(mass, fixed)
    w2 = np.linalg.eigvalsh(K / np.sqrt(np.outer(mass, mass)))
    return 2 / np.sqrt(w2.max())


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
