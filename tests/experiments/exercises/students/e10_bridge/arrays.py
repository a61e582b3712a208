import numpy as np

EXERCISE = 10


def compatibility(bridge):
    """How the lengths of the members change with the joints: shape (m, 2 j)."""
    p, q = np.asarray(bridge.members).T
    d = bridge.joints[q] - bridge.joints[p]
    u = d / np.linalg.norm(d, axis=1)[:, None]
    m = np.arange(len(p))
    B = np.zeros((len(p), 2 * len(bridge.joints)))
    for axis in (0, 1):
        B[m, 2 * p + axis] = -u[:, axis]
        B[m, 2 * q + axis] = u[:, axis]
    return B


def free(bridge):
    mask = np.ones((len(bridge.joints), 2), dtype=bool)
    mask[bridge.pinned] = False
    mask[bridge.roller, 1] = False
    return mask.ravel()


def heaviest(bridge):
    # only the free directions: then the supports are not unknowns
    loads = np.zeros((len(bridge.joints), 2))
    loads[:, 1] = -bridge.masses * bridge.gravity
    mask = free(bridge)
    B = compatibility(bridge)[:, mask]
    tension = np.linalg.solve(B.T, loads.ravel()[mask])
    i = np.argmax(np.abs(tension))
    return i, tension[i]


def largest_dt(bridge):
    mask = free(bridge)
    B = compatibility(bridge)[:, mask]
    K = B.T @ np.diag(bridge.stiffness) @ B
    M = np.diag(np.repeat(bridge.masses, 2)[mask])
    w2 = np.sort(np.linalg.eigvals(np.linalg.solve(M, K)).real)
    return 2 / np.sqrt(w2[-1])
