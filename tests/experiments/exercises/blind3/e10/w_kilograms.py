"""Exercise 10: the bridge. Run me: python bridge.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 10


def incidence(bridge):
    """Column k: unit pull of member k on both of its joints."""
    G = np.zeros((2 * len(bridge.joints), len(bridge.members)))
    for k, (a, b) in enumerate(bridge.members):
        r = bridge.joints[b] - bridge.joints[a]
        r = r / np.hypot(*r)
        G[[2 * a, 2 * a + 1], k] = r
        G[[2 * b, 2 * b + 1], k] = -r
    return G


def held(bridge):
    return [2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + 1]


def heaviest(bridge):
    """The number of the member with the largest force, and the force [N], positive in tension."""
    G = incidence(bridge)
    R = np.eye(len(G))[:, held(bridge)]
    down = np.zeros(len(G))
    down[1::2] = bridge.masses
    s = np.linalg.solve(np.c_[G, R], down)[: G.shape[1]]
    k = np.argmax(np.abs(s))
    return k, s[k]


def largest_dt(bridge):
    """The largest stable dt [s] of kick-drift."""
    G = np.delete(incidence(bridge), held(bridge), axis=0)
    m = np.delete(np.repeat(bridge.masses, 2), held(bridge))
    # singular values of M^-1/2 G k^1/2 are the frequencies
    w = np.linalg.svd(G * np.sqrt(bridge.stiffness) / np.sqrt(m)[:, None], compute_uv=False)
    return 2 / w[0]


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
