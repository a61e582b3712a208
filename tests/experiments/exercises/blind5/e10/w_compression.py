"""Exercise 10: the bridge. Run me: python bridge.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 10


def heaviest(bridge):
    """The number of the member with the largest force, and the force [N], positive in tension."""
    j, m = len(bridge.joints), len(bridge.members)
    A = np.zeros((2 * j, m + 3))
    b = np.zeros(2 * j)
    for i, (p, q) in enumerate(bridge.members):
        d = bridge.joints[q] - bridge.joints[p]
        e = d / np.linalg.norm(d)
        A[2 * p:2 * p + 2, i] = -e
        A[2 * q:2 * q + 2, i] = e
    A[2 * bridge.pinned, m] = 1
    A[2 * bridge.pinned + 1, m + 1] = 1
    A[2 * bridge.roller + 1, m + 2] = 1
    for i in range(j):
        b[2 * i + 1] = bridge.masses[i] * bridge.gravity
    solution = np.linalg.solve(A, b)
    member_forces = solution[:m]
    k = np.argmax(np.abs(member_forces))
    return int(k), float(member_forces[k])


def largest_dt(bridge):
    """The largest stable dt [s] of kick-drift."""
    j = len(bridge.joints)
    K = np.zeros((2 * j, 2 * j))
    for (p, q), k in zip(bridge.members, bridge.stiffness):
        d = bridge.joints[q] - bridge.joints[p]
        e = d / np.linalg.norm(d)
        block = k * np.outer(e, e)
        K[2 * p:2 * p + 2, 2 * p:2 * p + 2] += block
        K[2 * q:2 * q + 2, 2 * q:2 * q + 2] += block
        K[2 * p:2 * p + 2, 2 * q:2 * q + 2] -= block
        K[2 * q:2 * q + 2, 2 * p:2 * p + 2] -= block
    held = {2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + 1}
    keep = [i for i in range(2 * j) if i not in held]
    M = np.repeat(bridge.masses, 2)[keep]
    w2 = np.linalg.eigvals(K[np.ix_(keep, keep)] / M[:, None]).real
    return float(2 / np.sqrt(w2.max()))


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
