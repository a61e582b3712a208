"""Exercise 10: the bridge. Run me: python bridge.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 10


def direction(bridge, member):
    start, end = bridge.joints[member[0]], bridge.joints[member[1]]
    return (end - start) / np.linalg.norm(end - start)


def heaviest(bridge):
    """The number of the member with the largest force, and the force [N], positive in tension."""
    J = len(bridge.joints)
    A = np.zeros((J, 2, 2 * J))
    for number, member in enumerate(bridge.members):
        e = direction(bridge, member)
        A[member[0], :, number] = e
        A[member[1], :, number] = -e
    M = len(bridge.members)
    A[bridge.pinned, 0, M] = A[bridge.pinned, 1, M + 1] = A[bridge.roller, 1, M + 2] = 1.0
    b = np.zeros((J, 2))
    b[:, 1] = bridge.gravity * bridge.masses
    t = np.linalg.solve(A.reshape(2 * J, 2 * J), b.reshape(2 * J))[:M]
    winner = sorted(range(M), key=lambda i: -abs(t[i]))[0]
    return winner, float(t[winner])


def largest_dt(bridge):
    """The largest stable dt [s] of kick-drift."""
    J = len(bridge.joints)
    K = np.zeros((2 * J, 2 * J))
    for number, member in enumerate(bridge.members):
        p, q = 2 * member[0], 2 * member[1]
        e = direction(bridge, member)
        E = bridge.stiffness[number] * np.outer(e, e)
        for s, t, sign in ((p, p, 1), (q, q, 1), (p, q, -1), (q, p, -1)):
            K[s:s + 2, t:t + 2] += sign * E
    K /= np.repeat(bridge.masses, 2)[:, None]
    supports = (2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + 1)
    K = np.delete(np.delete(K, supports, 0), supports, 1)
    w = np.linalg.eigvals(K).real.max()
    return float(2 / w)


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
