"""Exercise 10: the bridge. Run me: python bridge.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 10


def members(bridge):
    for i in range(len(bridge.members)):
        p, q = bridge.members[i]
        r = bridge.joints[q] - bridge.joints[p]
        yield i, p, q, r / np.sqrt(r @ r)


def heaviest(bridge):
    """The number of the member with the largest force, and the force [N], positive in tension."""
    j = len(bridge.joints)
    A = np.zeros((j, 2, len(bridge.members) + 3))
    for i, p, q, u in members(bridge):
        A[p, :, i] = u
        A[q, :, i] = -u
    A[bridge.pinned, :, -3:-1] = np.eye(2)
    A[bridge.roller, 1, -1] = 1
    w = np.zeros((j, 2))
    w[:, 1] = bridge.gravity * bridge.masses
    f = np.linalg.solve(A.reshape(2 * j, -1), w.reshape(-1))[:-3]
    i = abs(f).argmax()
    return i, f[i]


def largest_dt(bridge):
    """The largest stable dt [s] of kick-drift."""
    j = len(bridge.joints)
    K = np.zeros((j, 2, j, 2))
    for i, p, q, u in members(bridge):
        B = bridge.stiffness[i] * u[:, None] * u[None, :]
        K[p, :, p] += B
        K[q, :, q] += B
        K[p, :, q] += B
        K[q, :, p] += B
    K = K / bridge.masses[:, None, None, None]
    K[bridge.pinned] = 0
    K[bridge.roller, 1] = 0
    w2 = np.linalg.eigvals(K.reshape(2 * j, 2 * j)).real.max()
    return 2 * w2**-0.5


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
