import numpy as np

EXERCISE = 10


def columns(b):
    C = np.zeros((2 * len(b.joints), len(b.members)))
    for n, (i, j) in enumerate(b.members):
        e = b.joints[j] - b.joints[i]
        e = e / np.sqrt(e @ e)
        C[2 * i : 2 * i + 2, n] = e
        C[2 * j : 2 * j + 2, n] = -e
    return C


def heaviest(bridge):
    C = columns(bridge)
    supports = [2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + 1]
    R = np.eye(len(C))[:, supports]
    load = np.zeros(len(C))
    load[1::2] = bridge.masses * bridge.gravity
    f = np.linalg.solve(np.hstack([C, R]), load)[:-3]
    n = np.abs(f).argmax()
    return n, f[n]


def largest_dt(bridge):
    C = columns(bridge)
    held = [2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller, 2 * bridge.roller + 1]
    free = np.setdiff1d(np.arange(len(C)), held)
    K = C @ np.diag(bridge.stiffness) @ C.T
    M = np.diag(np.repeat(bridge.masses, 2))
    w2 = np.linalg.eigvals(np.linalg.inv(M[np.ix_(free, free)]) @ K[np.ix_(free, free)])
    return 2 / np.sqrt(max(w2.real))
