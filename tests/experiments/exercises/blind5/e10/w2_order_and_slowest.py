"""Exercise 10: the bridge. Run me: python bridge.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 10


def matrix(bridge):
    rows = 2 * len(bridge.joints)
    D = np.zeros((rows, len(bridge.members)))
    for i, (p, q) in enumerate(bridge.members):
        e = bridge.joints[q] - bridge.joints[p]
        e = e / np.hypot(*e)
        D[2 * p:2 * p + 2, i] = e
        D[2 * q:2 * q + 2, i] = -e
    return D


def heaviest(bridge):
    """The number of the member with the largest force, and the force [N], positive in tension."""
    D = matrix(bridge)
    S = np.zeros((len(D), 3))
    S[2 * bridge.pinned, 0] = 1
    S[2 * bridge.pinned + 1, 1] = 1
    S[2 * bridge.roller + 1, 2] = 1
    W = np.zeros(len(D))
    W[1::2] = -bridge.masses * bridge.gravity
    f = np.linalg.solve(np.hstack([D, S]), -W)[:-3]
    i = int(np.argmax(np.abs(f)))
    return float(f[i]), i


def largest_dt(bridge):
    """The largest stable dt [s] of kick-drift."""
    D = matrix(bridge)
    K = D @ np.diag(bridge.stiffness) @ D.T
    mass = np.repeat(bridge.masses, 2)
    held = [2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + 1]
    free = [i for i in range(len(K)) if i not in held]
    A = K[np.ix_(free, free)] / np.sqrt(mass[free])[:, None] / np.sqrt(mass[free])[None, :]
    w = np.sqrt(np.linalg.eigvalsh(A))
    return float(2 / w[0])


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
