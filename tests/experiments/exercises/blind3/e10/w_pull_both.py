"""Exercise 10: the bridge. Run me: python bridge.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 10


def heaviest(bridge):
    """The number of the member with the largest force, and the force [N], positive in tension."""
    j, m = len(bridge.joints), len(bridge.members)
    A = np.zeros((2 * j, m + 3))
    for k in range(m):
        a, b = bridge.members[k]
        d = bridge.joints[b] - bridge.joints[a]
        u = d / np.linalg.norm(d)
        A[2 * a, k], A[2 * a + 1, k] = u[0], u[1]
        A[2 * b, k], A[2 * b + 1, k] = u[0], u[1]
    A[2 * bridge.pinned, m] = 1
    A[2 * bridge.pinned + 1, m + 1] = 1
    A[2 * bridge.roller + 1, m + 2] = 1
    b = np.zeros(2 * j)
    b[1::2] = bridge.masses * bridge.gravity
    x = np.linalg.lstsq(A, b, rcond=None)[0]
    T = x[:m]
    k = np.argmax(np.abs(T))
    return k, T[k]


def largest_dt(bridge):
    """The largest stable dt [s] of kick-drift."""
    j = len(bridge.joints)
    K = np.zeros((2 * j, 2 * j))
    for k, (a, b) in enumerate(bridge.members):
        d = bridge.joints[b] - bridge.joints[a]
        u = d / np.linalg.norm(d)
        h = np.concatenate([u, -u])
        idx = np.array([2 * a, 2 * a + 1, 2 * b, 2 * b + 1])
        K[np.ix_(idx, idx)] += bridge.stiffness[k] * np.outer(h, h)
    free = [i for i in range(2 * j) if i not in (2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + 1)]
    m = np.repeat(bridge.masses, 2)[free]
    A = K[np.ix_(free, free)] / m[:, None]
    w = np.sqrt(max(np.linalg.eigvals(A).real))
    return 1 / w


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
