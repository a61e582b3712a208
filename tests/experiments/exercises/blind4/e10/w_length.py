"""Exercise 10: the bridge. Run me: python bridge.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 10


def heaviest(bridge):
    """The number of the member with the largest force, and the force [N], positive in tension."""
    J = len(bridge.joints)
    nm = len(bridge.members)
    A = np.zeros((2 * J, 2 * J))
    b = np.zeros(2 * J)
    for k in range(nm):
        i, j = bridge.members[k]
        d = bridge.joints[j] - bridge.joints[i]
        l = np.linalg.norm(d)
        A[2 * i, k] = d[0] / l
        A[2 * i + 1, k] = d[1] / l
        A[2 * j, k] = -d[0] / l
        A[2 * j + 1, k] = -d[1] / l
    # supports
    A[2 * bridge.pinned, nm] = 1
    A[2 * bridge.pinned + 1, nm + 1] = 1
    A[2 * bridge.roller + 1, nm + 2] = 1
    # weights
    for i in range(J):
        b[2 * i + 1] = bridge.masses[i] * bridge.gravity
    F = np.linalg.solve(A, b)[:nm]
    best = np.argmax(np.abs(F))
    return int(best), float(F[best])


def largest_dt(bridge):
    """The largest stable dt [s] of kick-drift."""
    J = len(bridge.joints)
    K = np.zeros((2 * J, 2 * J))
    for k, (i, j) in enumerate(bridge.members):
        d = bridge.joints[j] - bridge.joints[i]
        e = np.zeros(2 * J)
        e[[2 * i, 2 * i + 1]] = d
        e[[2 * j, 2 * j + 1]] = -d
        K += bridge.stiffness[k] * np.outer(e, e)
    fixed = {2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + 1}
    free = [i for i in range(2 * J) if i not in fixed]
    M = np.repeat(bridge.masses, 2)
    w2 = np.linalg.eigvals(K[np.ix_(free, free)] / M[free][:, None])
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
