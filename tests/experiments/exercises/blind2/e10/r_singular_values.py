import numpy as np

EXERCISE = 10


def equilibrium(b):
    rows = []
    for i, j in b.members:
        e = (b.joints[j] - b.joints[i]) / np.linalg.norm(b.joints[j] - b.joints[i])
        row = np.zeros_like(b.joints)
        row[i], row[j] = e, -e
        rows.append(row.ravel())
    free = np.ones(b.joints.shape, bool)
    free[b.pinned] = False
    free[b.roller, 1] = False
    return np.array(rows).T, free.ravel()


def heaviest(bridge):
    C, free = equilibrium(bridge)
    weight = np.zeros_like(bridge.joints)
    weight[:, 1] = bridge.masses * bridge.gravity
    f = np.linalg.solve(C[free], weight.ravel()[free])
    i = max(range(len(f)), key=lambda n: abs(f[n]))
    return i, f[i]


def largest_dt(bridge):
    C, free = equilibrium(bridge)
    scaled = C[free] * np.sqrt(bridge.stiffness) / np.sqrt(np.repeat(bridge.masses, 2)[free])[:, None]
    return 2 / np.linalg.svd(scaled, compute_uv=False).max()
