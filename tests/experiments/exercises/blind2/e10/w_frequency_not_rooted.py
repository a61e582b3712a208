import numpy as np

EXERCISE = 10


def columns(b):
    C = np.zeros((2 * len(b.joints), len(b.members)))
    for n, (i, j) in enumerate(b.members):
        e = b.joints[j] - b.joints[i]
        e = e / np.linalg.norm(e)
        C[[2 * i, 2 * i + 1], n] = e
        C[[2 * j, 2 * j + 1], n] = -e
    return C


def heaviest(bridge):
    C = columns(bridge)
    A = np.hstack([C, np.zeros((len(C), 3))])
    A[2 * bridge.pinned, -3] = 1
    A[2 * bridge.pinned + 1, -2] = 1
    A[2 * bridge.roller + 1, -1] = 1
    b = np.zeros(len(C))
    b[1::2] = bridge.masses * bridge.gravity
    f = np.linalg.solve(A, b)[: C.shape[1]]
    n = int(np.argmax(abs(f)))
    return n, float(f[n])


def largest_dt(bridge):
    C = columns(bridge)
    free = np.delete(np.arange(len(C)), [2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + 1])
    C = C[free] / np.sqrt(np.repeat(bridge.masses, 2)[free])[:, None]
    w = np.linalg.eigvalsh(C @ np.diag(bridge.stiffness) @ C.T).max()
    return 2 / w
