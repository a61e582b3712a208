"""Exercise 10: the bridge. Run me: python bridge.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 10


def geometry(bridge):
    """Rows: members; columns: directions in which joints move. Entry: how the length changes."""
    a, b = bridge.members.T
    d = bridge.joints[b] - bridge.joints[a]
    e = d / np.linalg.norm(d, axis=1)[:, None]
    m, j = len(bridge.members), len(bridge.joints)
    C = np.zeros((m, j, 2))
    C[np.arange(m), a] = -e
    C[np.arange(m), b] = e
    free = np.ones((j, 2), dtype=bool)
    free[bridge.pinned] = False
    free[bridge.roller, 1] = False
    return C.reshape(m, -1)[:, free.ravel()], free


def heaviest(bridge):
    """The number of the member with the largest force, and the force [N], positive in tension."""
    C, free = geometry(bridge)
    load = np.zeros(free.shape)
    load[:, 1] = -bridge.masses * bridge.gravity
    T = np.linalg.solve(C.T, load[free])  # tension does work on lengthening: C^T T = load
    i = int(np.abs(T).argmax())
    return i, float(T[i])


def largest_dt(bridge):
    """The largest stable dt [s] of kick-drift."""
    C, free = geometry(bridge)
    root = np.sqrt(np.repeat(bridge.masses, 2)[free.ravel()])
    A = np.sqrt(bridge.stiffness)[:, None] * C / root
    return 2 / np.linalg.svd(A, compute_uv=False)[0]


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
