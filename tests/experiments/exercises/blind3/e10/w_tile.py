"""Exercise 10: the bridge. Run me: python bridge.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 10


def unit_vectors(bridge):
    for a, b in bridge.members:
        d = bridge.joints[b] - bridge.joints[a]
        yield a, b, d / np.sqrt(d @ d)


def heaviest(bridge):
    """The number of the member with the largest force, and the force [N], positive in tension."""
    n_j, n_m = len(bridge.joints), len(bridge.members)
    # unknowns: member forces, then the three forces of the supports
    A = np.zeros((n_j, 2, n_m + 3))
    for i, (a, b, u) in enumerate(unit_vectors(bridge)):
        A[a, :, i] += u
        A[b, :, i] -= u
    A[bridge.pinned, 0, -3] = A[bridge.pinned, 1, -2] = A[bridge.roller, 1, -1] = 1.0
    rhs = np.zeros((n_j, 2))
    rhs[:, 1] = bridge.gravity * bridge.masses
    N = np.linalg.solve(A.reshape(2 * n_j, -1), rhs.ravel())[:-3]
    worst = np.abs(N).argmax()
    return worst, N[worst]


def largest_dt(bridge):
    """The largest stable dt [s] of kick-drift."""
    n_j = len(bridge.joints)
    K = np.zeros((n_j, 2, n_j, 2))
    for k, (a, b, u) in zip(bridge.stiffness, unit_vectors(bridge)):
        kk = k * np.outer(u, u)
        K[a, :, a, :] += kk
        K[b, :, b, :] += kk
        K[a, :, b, :] -= kk
        K[b, :, a, :] -= kk
    K = K.reshape(2 * n_j, 2 * n_j)
    m = np.tile(bridge.masses, 2)
    keep = np.setdiff1d(np.arange(2 * n_j), [2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + 1])
    D = K[np.ix_(keep, keep)] / np.sqrt(np.outer(m[keep], m[keep]))
    return 2 / np.sqrt(np.linalg.eigvalsh(D).max())


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
