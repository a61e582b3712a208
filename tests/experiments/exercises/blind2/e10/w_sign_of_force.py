import numpy as np

EXERCISE = 10


def system(b):
    j, m = len(b.joints), len(b.members)
    A = np.zeros((2 * j, m + 3))
    rhs = np.zeros(2 * j)
    for i, (p, q) in enumerate(b.members):
        d = b.joints[q] - b.joints[p]
        e = d / np.linalg.norm(d)
        A[2 * p : 2 * p + 2, i] = e
        A[2 * q : 2 * q + 2, i] = -e
    A[2 * b.pinned, m] = 1
    A[2 * b.pinned + 1, m + 1] = 1
    A[2 * b.roller + 1, m + 2] = 1
    rhs[1::2] = b.masses * b.gravity
    return A, rhs


def heaviest(bridge):
    A, rhs = system(bridge)
    f = -np.linalg.solve(A, rhs)[: len(bridge.members)]
    i = np.argmax(np.abs(f))
    return i, f[i]


def largest_dt(bridge):
    j = len(bridge.joints)
    K = np.zeros((2 * j, 2 * j))
    for (p, q), k in zip(bridge.members, bridge.stiffness):
        d = bridge.joints[q] - bridge.joints[p]
        e = d / np.linalg.norm(d)
        B = k * np.outer(e, e)
        for a, c, s in ((p, p, 1), (q, q, 1), (p, q, -1), (q, p, -1)):
            K[2 * a : 2 * a + 2, 2 * c : 2 * c + 2] += s * B
    free = [i for i in range(2 * j) if i not in (2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + 1)]
    m = np.repeat(bridge.masses, 2)[free]
    w2 = np.linalg.eigvals(K[np.ix_(free, free)] / m[:, None])
    return 2 / np.sqrt(w2.real.max())
