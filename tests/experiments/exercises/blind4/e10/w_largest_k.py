"""Exercise 10: the bridge. Run me: python bridge.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 10


def heaviest(bridge):
    """The number of the member with the largest force, and the force [N], positive in tension."""
    J, M = bridge.joints, bridge.members
    d = J[M[:, 1]] - J[M[:, 0]]
    d = d / np.hypot(d[:, 0], d[:, 1])[:, None]
    A = np.zeros((2 * len(J), len(M) + 3))
    cols = np.arange(len(M))
    for axis in (0, 1):
        A[2 * M[:, 0] + axis, cols] = d[:, axis]
        A[2 * M[:, 1] + axis, cols] = -d[:, axis]
    A[2 * bridge.pinned, -3] = A[2 * bridge.pinned + 1, -2] = A[2 * bridge.roller + 1, -1] = 1
    b = np.zeros(2 * len(J))
    b[1::2] = bridge.masses * bridge.gravity
    N = np.linalg.lstsq(A, b, rcond=None)[0][: len(M)]
    which = np.argsort(-np.abs(N))[0]
    return which, N[which]


def largest_dt(bridge):
    """The largest stable dt [s] of kick-drift."""
    w = np.sqrt(bridge.stiffness.max() / bridge.masses.min())
    return 2 / w


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
