import numpy as np

EXERCISE = 10


def units(b):
    d = b.joints[b.members[:, 1]] - b.joints[b.members[:, 0]]
    return d / np.linalg.norm(d, axis=1)[:, None]


def incidence(b):
    C = np.zeros((2 * len(b.joints), len(b.members)))
    for n, ((i, j), e) in enumerate(zip(b.members, units(b))):
        C[2 * i : 2 * i + 2, n] += e
        C[2 * j : 2 * j + 2, n] -= e
    return C


def heaviest(bridge):
    C = incidence(bridge)
    R = np.zeros((len(C), 3))
    R[2 * bridge.pinned, 0] = R[2 * bridge.pinned + 1, 1] = R[2 * bridge.roller + 1, 2] = 1
    load = np.zeros(len(C))
    load[1::2] = -bridge.masses * bridge.gravity
    f = np.linalg.solve(np.hstack([C, R]), -load)[: C.shape[1]]
    n = int(np.argmax(f))
    return n, f[n]


def largest_dt(bridge):
    C = incidence(bridge)
    keep = np.ones(len(C), bool)
    keep[[2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + 1]] = False
    K = (C * bridge.stiffness) @ C.T
    s = 1 / np.sqrt(np.repeat(bridge.masses, 2))
    D = (s[:, None] * K * s)[keep][:, keep]
    return 2 / np.sqrt(np.linalg.eigvalsh(D)[-1])
