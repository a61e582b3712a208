"""Exercise 10: the bridge. Run me: python bridge.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 10


def directions(bridge):
    a, b = np.asarray(bridge.members).T
    d = bridge.joints[b] - bridge.joints[a]
    return a, b, d / np.linalg.norm(d, axis=1, keepdims=True)


def compatibility(bridge):
    """Row k: how the length of member k changes with each displacement."""
    a, b, u = directions(bridge)
    m, j = len(a), len(bridge.joints)
    B = np.zeros((m, j, 2))
    B[np.arange(m), a] = -u
    B[np.arange(m), b] = u
    return B.reshape(m, 2 * j)


def heaviest(bridge):
    """The number of the member with the largest force, and the force [N], positive in tension."""
    B = compatibility(bridge)
    m, n = B.shape
    supports = np.zeros((n, 3))
    supports[2 * bridge.pinned, 0] = 1
    supports[2 * bridge.pinned + 1, 1] = 1
    supports[2 * bridge.roller + 1, 2] = 1
    load = np.zeros(n)
    load[1::2] = -bridge.masses * bridge.gravity
    solution = np.linalg.solve(np.hstack([-B.T, supports]), -load)
    forces = solution[:m]
    k = np.argmax(abs(forces))
    return int(k), float(forces[k])


def largest_dt(bridge):
    """The largest stable dt [s] of kick-drift."""
    B = compatibility(bridge)
    K = B.T @ np.diag(bridge.stiffness) @ B
    s = 1 / np.sqrt(np.repeat(bridge.masses, 2))
    S = s[:, None] * K * s
    fixed = [2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller, 2 * bridge.roller + 1]
    S = np.delete(np.delete(S, fixed, axis=0), fixed, axis=1)
    return 2 / np.sqrt(np.linalg.eigvalsh(S)[-1])


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
