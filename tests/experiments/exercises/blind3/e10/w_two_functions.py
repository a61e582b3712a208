"""Exercise 10: the bridge. Run me: python bridge.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 10


def heaviest(bridge):
    """The number of the member with the largest force, and the force [N], positive in tension."""
    m = len(bridge.members)
    rows = np.zeros((len(bridge.joints), 2, m + 3))
    for k, (a, b) in enumerate(bridge.members):
        direction = bridge.joints[b] - bridge.joints[a]
        rows[a, :, k] = direction
        rows[b, :, k] = -direction
    rows[bridge.pinned, 0, m] = 1
    rows[bridge.pinned, 1, m + 1] = 1
    rows[bridge.roller, 1, m + 2] = 1
    load = np.zeros((len(bridge.joints), 2))
    load[:, 1] = bridge.masses * bridge.gravity
    force = np.linalg.solve(rows.reshape(-1, m + 3), load.reshape(-1))[:m]
    number = int(np.argmax(np.abs(force)))
    return number, float(force[number])


def largest_dt(bridge):
    """The largest stable dt [s] of kick-drift."""
    n = 2 * len(bridge.joints)
    B = np.zeros((len(bridge.members), n))
    for k, (a, b) in enumerate(bridge.members):
        d = bridge.joints[b] - bridge.joints[a]
        d /= np.linalg.norm(d)
        B[k, 2 * a : 2 * a + 2] = -d
        B[k, 2 * b : 2 * b + 2] = d
    B = np.delete(B, [2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + 1], axis=1)
    m = np.delete(np.repeat(bridge.masses, 2), [2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + 1])
    B = B / np.sqrt(m)
    w2 = np.sort(np.linalg.eigvalsh(B.T @ np.diag(bridge.stiffness) @ B))
    return 2 / np.sqrt(w2[0])


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
