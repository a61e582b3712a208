"""Exercise 10: the bridge. Run me: python bridge.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 10


def heaviest(bridge):
    """The number of the member with the largest force, and the force [N], positive in tension."""
    joints, members = bridge.joints, np.asarray(bridge.members)
    vec = joints[members[:, 1]] - joints[members[:, 0]]
    vec = vec / np.linalg.norm(vec, axis=1)[:, None]
    nm, nj = len(members), len(joints)
    Ax = np.zeros((nj, nm + 3))
    Ay = np.zeros((nj, nm + 3))
    cols = np.arange(nm)
    Ax[members[:, 0], cols] = vec[:, 0]
    Ax[members[:, 1], cols] = -vec[:, 0]
    Ay[members[:, 0], cols] = vec[:, 1]
    Ay[members[:, 1], cols] = -vec[:, 1]
    Ax[bridge.pinned, nm] = 1
    Ay[bridge.pinned, nm + 1] = 1
    Ay[bridge.roller, nm + 2] = 1
    rhs = np.concatenate([np.zeros(nj), bridge.masses * bridge.gravity])
    sol = np.linalg.solve(np.vstack([Ax, Ay]), rhs)[:nm]
    i = int(abs(sol).argmax())
    return i, sol[i]


def largest_dt(bridge):
    """The largest stable dt [s] of kick-drift."""
    nj = len(bridge.joints)
    K = np.zeros((2 * nj, 2 * nj))
    for k, (a, b) in zip(bridge.stiffness, bridge.members):
        d = bridge.joints[b] - bridge.joints[a]
        d = d / np.linalg.norm(d)
        row = np.zeros((nj, 2))
        row[a], row[b] = d, -d
        row = row.ravel()
        K = K + k * np.outer(row, row)
    m = np.repeat(bridge.masses, 2)
    w2 = np.linalg.eigvals(K / m[:, None])
    return 2 / np.sqrt(w2.real.max())


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
