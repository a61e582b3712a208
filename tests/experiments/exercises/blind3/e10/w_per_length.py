"""Exercise 10: the bridge. Run me: python bridge.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 10


def heaviest(bridge):
    """The number of the member with the largest force, and the force [N], positive in tension."""
    n = len(bridge.members)
    eq = np.zeros((2 * len(bridge.joints), n + 3))
    for i, member in enumerate(bridge.members):
        for here, there in (member, member[::-1]):
            d = bridge.joints[there] - bridge.joints[here]
            eq[2 * here : 2 * here + 2, i] = d / np.linalg.norm(d)
    eq[2 * bridge.pinned : 2 * bridge.pinned + 2, n : n + 2] = np.eye(2)
    eq[2 * bridge.roller + 1, n + 2] = 1
    weights = np.kron(bridge.masses, [0, bridge.gravity])
    t = np.linalg.solve(eq, weights)[:n]
    i = np.argmax(t**2)
    return i, t[i]


def largest_dt(bridge):
    """The largest stable dt [s] of kick-drift."""
    size = 2 * len(bridge.joints)
    K = np.zeros((size, size))
    for i, (a, b) in enumerate(bridge.members):
        d = bridge.joints[b] - bridge.joints[a]
        L = np.linalg.norm(d)
        c, s = d / L
        g = np.array([-c, -s, c, s])
        index = [2 * a, 2 * a + 1, 2 * b, 2 * b + 1]
        K[np.ix_(index, index)] += bridge.stiffness[i] / L * np.outer(g, g)
    mass = np.kron(bridge.masses, [1, 1])
    fixed = [2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + 1]
    K = np.delete(np.delete(K, fixed, 0), fixed, 1)
    mass = np.delete(mass, fixed)
    w2 = np.linalg.eigvals(np.linalg.solve(np.diag(mass), K))
    return 2 / np.sqrt(np.max(np.real(w2)))


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
