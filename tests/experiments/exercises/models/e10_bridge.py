import numpy as np

EXERCISE = 10


def directions(bridge):
    gap = bridge.joints[bridge.members[:, 1]] - bridge.joints[bridge.members[:, 0]]
    return gap / np.linalg.norm(gap, axis=1)[:, None]


def heaviest(bridge):
    members, unit, count = bridge.members, directions(bridge), len(bridge.joints)
    equations = np.zeros((2 * count, len(members) + 3))
    for j, (a, b) in enumerate(members):
        equations[[2 * a, 2 * a + 1], j] = unit[j]
        equations[[2 * b, 2 * b + 1], j] = -unit[j]
    equations[2 * bridge.pinned, -3] = equations[2 * bridge.pinned + 1, -2] = 1
    equations[2 * bridge.roller + 1, -1] = 1
    weights = np.zeros(2 * count)
    weights[1::2] = bridge.masses * bridge.gravity
    forces = np.linalg.solve(equations, weights)[: len(members)]
    most = np.argmax(np.abs(forces))
    return most, forces[most]


def largest_dt(bridge):
    count = len(bridge.joints)
    stretch = np.zeros((len(bridge.members), 2 * count))
    for j, ((a, b), u) in enumerate(zip(bridge.members, directions(bridge), strict=True)):
        stretch[j, [2 * a, 2 * a + 1]] = -u
        stretch[j, [2 * b, 2 * b + 1]] = u
    held = {2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + 1}
    free = [i for i in range(2 * count) if i not in held]
    mass = np.repeat(bridge.masses, 2)[free]
    matrix = (stretch.T * bridge.stiffness @ stretch)[np.ix_(free, free)] / mass[:, None]
    return 2 / np.sqrt(np.linalg.eigvals(matrix).real.max())
