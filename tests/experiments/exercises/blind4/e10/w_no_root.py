"""Exercise 10: the bridge. Run me: python bridge.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 10


def directions(bridge):
    start = bridge.joints[bridge.members[:, 0]]
    end = bridge.joints[bridge.members[:, 1]]
    vec = end - start
    return vec / np.linalg.norm(vec, axis=1, keepdims=True)


def member_matrix(bridge):
    """(2 j, m): what a tension of 1 N in member m does to each joint."""
    e = directions(bridge)
    B = np.zeros((len(bridge.joints), 2, len(bridge.members)))
    for m, (p, q) in enumerate(bridge.members):
        B[p, :, m] += e[m]
        B[q, :, m] -= e[m]
    return B.reshape(-1, len(bridge.members))


def held(bridge):
    return [2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + 1]


def heaviest(bridge):
    """The number of the member with the largest force, and the force [N], positive in tension."""
    B = member_matrix(bridge)
    supports = np.eye(len(B))[:, held(bridge)]
    load = np.zeros((len(bridge.joints), 2))
    load[:, 1] = -bridge.gravity * bridge.masses
    solution = np.linalg.solve(np.hstack([B, supports]), -load.ravel())
    tension = solution[:-3]
    n = int(np.argmax(np.abs(tension)))
    return n, tension[n]


def largest_dt(bridge):
    """The largest stable dt [s] of kick-drift."""
    B = member_matrix(bridge)
    K = B @ np.diag(bridge.stiffness) @ B.T
    idx = np.setdiff1d(np.arange(len(B)), held(bridge))
    mass = np.repeat(bridge.masses, 2)[idx]
    K = K[idx][:, idx]
    # symmetric form
    sym = K / np.sqrt(np.outer(mass, mass))
    w = np.linalg.eigvalsh(sym)
    return 2 / w.max()


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
