import numpy as np

EXERCISE = 10


def heaviest(bridge):
    n, m = len(bridge.joints), len(bridge.members)
    A = np.zeros((2 * n, m + 3))
    b = np.zeros(2 * n)
    for e in range(m):
        s, t = bridge.members[e]
        d = bridge.joints[t] - bridge.joints[s]
        u = d / np.linalg.norm(d)
        A[2 * s : 2 * s + 2, e] = u
        A[2 * t : 2 * t + 2, e] = -u
    A[2 * bridge.pinned, m] = 1
    A[2 * bridge.pinned + 1, m + 1] = 1
    A[2 * bridge.roller + 1, m + 2] = 1
    for i in range(n):
        b[2 * i + 1] = bridge.masses[i] * bridge.gravity
    f = np.linalg.solve(A, b)[:m]
    worst = int(np.argmax(np.abs(f)))
    return worst, f[worst]


def largest_dt(bridge):
    n, m = len(bridge.joints), len(bridge.members)
    K = np.zeros((2 * n, 2 * n))
    for e in range(m):
        s, t = bridge.members[e]
        d = bridge.joints[t] - bridge.joints[s]
        L = np.linalg.norm(d)
        u = d / L
        g = np.zeros(2 * n)
        g[2 * s : 2 * s + 2] = u
        g[2 * t : 2 * t + 2] = -u
        K += bridge.stiffness[e] * np.outer(g, g)
    M = np.repeat(bridge.masses, 2)
    held = [2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + 1]
    free = [i for i in range(2 * n) if i not in held]
    A = (K / M[:, None])[np.ix_(free, free)]
    w = np.sqrt(np.linalg.eigvals(A).real.max())
    return 2 * np.sqrt(bridge.masses.min() / bridge.stiffness.max())
