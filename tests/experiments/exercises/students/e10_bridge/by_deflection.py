import numpy as np

EXERCISE = 10


def stiffness_matrix(bridge):
    n = len(bridge.joints)
    K = np.zeros((2 * n, 2 * n))
    for (i, j), k in zip(bridge.members, bridge.stiffness):
        d = np.asarray(bridge.joints[j]) - bridge.joints[i]
        g = np.zeros(2 * n)
        g[2 * j : 2 * j + 2], g[2 * i : 2 * i + 2] = d, -d
        K += k * np.outer(g, g) / (d @ d)
    return K


def ways(bridge):
    held = {2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + 1}
    return sorted(set(range(2 * len(bridge.joints))) - held)


def heaviest(bridge):
    """By the displacements: K u = weight, then how much longer each member has become."""
    w = ways(bridge)
    load = np.ravel([(0.0, -m * bridge.gravity) for m in bridge.masses])
    u = np.zeros(2 * len(bridge.joints))
    u[w] = np.linalg.solve(stiffness_matrix(bridge)[np.ix_(w, w)], load[w])
    u = u.reshape(-1, 2)
    force = []
    for (i, j), k in zip(bridge.members, bridge.stiffness):
        d = bridge.joints[j] - bridge.joints[i]
        force.append(k * (u[j] - u[i]) @ d / np.hypot(d[0], d[1]))
    force = np.array(force)
    where = int(np.argsort(force**2)[-1])
    return [where, float(force[where])]


def largest_dt(bridge):
    """The fastest mode by power iteration."""
    w = ways(bridge)
    K = stiffness_matrix(bridge)[np.ix_(w, w)]
    m = np.repeat(bridge.masses, 2)[w]
    z = np.random.default_rng(0).normal(size=len(w))
    for _ in range(20000):
        z = K @ z / m
        z /= np.linalg.norm(z)
    return 2 / np.sqrt((z @ (K @ z)) / (z @ (m * z)))
