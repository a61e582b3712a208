"""Exercise 10: the bridge. Run me: python bridge.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 10


def build(bridge):
    """Lengthening of the members per displacement of the free directions; those directions' masses."""
    n = 2 * len(bridge.joints)
    free = np.array(sorted(set(range(n)) - {2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + 1}))
    B = np.zeros((len(bridge.members), n))
    for k, (a, b) in enumerate(bridge.members):
        e = bridge.joints[b] - bridge.joints[a]
        e = e / np.linalg.norm(e)
        B[k, 2 * a : 2 * a + 2] = -e
        B[k, 2 * b : 2 * b + 2] = e
    weight = np.zeros(n)
    weight[1::2] = -bridge.masses * bridge.gravity
    return B[:, free], np.repeat(bridge.masses, 2)[free], weight[free]


def heaviest(bridge):
    """The number of the member with the largest force, and the force [N], positive in tension."""
    B, _, weight = build(bridge)
    K = B.T @ (bridge.stiffness[:, None] * B)
    sag = np.linalg.solve(K, weight)
    tension = bridge.stiffness * (B @ sag)
    k = int(np.argmax(np.abs(tension)))
    return k, float(tension[k])


def largest_dt(bridge):
    """The largest stable dt [s] of kick-drift."""
    B, m, _ = build(bridge)
    # the same eigenvalues as M^-1 K, but on the members
    s = np.sqrt(bridge.stiffness)
    small = (s[:, None] * B / m) @ (B.T * s)
    return 2 / np.sqrt(np.linalg.eigvalsh(small)[-1])


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
