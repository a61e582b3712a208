import numpy as np

EXERCISE = 10


def heaviest(bridge):
    J = len(bridge.joints)
    M = len(bridge.members)
    A = np.zeros((2 * J, M + 3))
    b = np.zeros(2 * J)
    for i in range(M):
        p, q = bridge.members[i]
        dx = bridge.joints[q][0] - bridge.joints[p][0]
        dy = bridge.joints[q][1] - bridge.joints[p][1]
        L = (dx**2 + dy**2) ** 0.5
        # tension pulls p towards q, and q towards p
        A[2 * p, i] = dx / L
        A[2 * p + 1, i] = dy / L
        A[2 * q, i] = -dx / L
        A[2 * q + 1, i] = -dy / L
    A[2 * bridge.pinned, M] = 1
    A[2 * bridge.pinned + 1, M + 1] = 1
    A[2 * bridge.roller + 1, M + 2] = 1
    for j in range(J):
        b[2 * j + 1] = bridge.masses[j] * bridge.gravity
    T = np.linalg.solve(A, b)
    best = 0
    for i in range(M):
        if abs(T[i]) > abs(T[best]):
            best = i
    return best, T[best]


def largest_dt(bridge):
    J = len(bridge.joints)
    K = np.zeros((2 * J, 2 * J))
    for i in range(len(bridge.members)):
        p, q = bridge.members[i]
        d = bridge.joints[q] - bridge.joints[p]
        u = d / np.linalg.norm(d)
        for a in range(2):
            for c in range(2):
                k = bridge.stiffness[i] * u[a] * u[c]
                K[2 * p + a, 2 * p + c] += k
                K[2 * q + a, 2 * q + c] += k
                K[2 * p + a, 2 * q + c] -= k
                K[2 * q + a, 2 * p + c] -= k
    fixed = [2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + 1]
    free = [i for i in range(2 * J) if i not in fixed]
    W = np.zeros((len(free), len(free)))
    for a, i in enumerate(free):
        for c, j in enumerate(free):
            W[a, c] = K[i, j] / bridge.masses[i // 2]
    w2 = max(np.linalg.eigvals(W).real)
    return 2 / w2**0.5
