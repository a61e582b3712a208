"""Exercise 10: the bridge. Run me: python bridge.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 10


def unit(bridge, p, q):
    d = bridge.joints[q] - bridge.joints[p]
    return d / np.sqrt(d[0] ** 2 + d[1] ** 2)


def heaviest(bridge):
    """The number of the member with the largest force, and the force [N], positive in tension."""
    J, M = len(bridge.joints), len(bridge.members)
    A = np.zeros((2 * J, M + 3))
    rhs = np.zeros(2 * J)
    for i, (p, q) in enumerate(bridge.members):
        u = unit(bridge, p, q)
        A[2 * p : 2 * p + 2, i] += u
        A[2 * q : 2 * q + 2, i] -= u
    A[2 * bridge.pinned, M] = 1
    A[2 * bridge.pinned + 1, M + 1] = 1
    A[2 * bridge.roller + 1, M + 2] = 1
    for j in range(J):
        rhs[2 * j + 1] = bridge.masses[j] * bridge.gravity
    forces = np.linalg.solve(A, rhs)[:M]
    worst = max(range(M), key=lambda i: abs(forces[i]))
    return worst, forces[worst]


def largest_dt(bridge):
    """The largest stable dt [s] of kick-drift."""
    J = len(bridge.joints)
    K = np.zeros((2 * J, 2 * J))
    for (p, q), k in zip(bridge.members, bridge.stiffness):
        u = unit(bridge, p, q)
        block = k * np.outer(u, u)
        P, Q = slice(2 * p, 2 * p + 2), slice(2 * q, 2 * q + 2)
        K[P, P] += block
        K[Q, Q] += block
        K[P, Q] -= block
        K[Q, P] -= block
    D = K / np.repeat(bridge.masses, 2)[:, None]
    held = [2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + 1]
    D = np.delete(np.delete(D, held, axis=0), held, axis=1)
    w2 = np.linalg.eigvals(D).real
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
