"""Exercise 10: the bridge. Run me: python bridge.py."""

from types import SimpleNamespace

import numpy as np
from math import hypot, sqrt

EXERCISE = 10


def heaviest(bridge):
    """The number of the member with the largest force, and the force [N], positive in tension."""
    members = [(int(p), int(q)) for p, q in bridge.members]
    size = 2 * len(bridge.joints)
    matrix = [[0.0] * size for _ in range(size)]
    loads = [0.0] * size
    for col, (p, q) in enumerate(members):
        dx = bridge.joints[q][0] - bridge.joints[p][0]
        dy = bridge.joints[q][1] - bridge.joints[p][1]
        length = hypot(dx, dy)
        for joint, sign in ((p, 1), (q, -1)):
            matrix[2 * joint][col] = sign * dx / length
            matrix[2 * joint + 1][col] = sign * dy / length
    rows = [2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + 1]
    for number, row in enumerate(rows):
        matrix[row][len(members) + number] = 1.0
    for joint, mass in enumerate(bridge.masses):
        loads[2 * joint + 1] = mass * bridge.gravity
    forces = np.linalg.solve(matrix, loads)
    worst, force = 0, 0.0
    for i in range(len(members)):
        if abs(forces[i]) > force:
            worst, force = i, abs(forces[i])
    return worst, force


def largest_dt(bridge):
    """The largest stable dt [s] of kick-drift."""
    # columns: how hard a member with sqrt(k) pulls on a direction, over sqrt(m)
    size = 2 * len(bridge.joints)
    G = np.zeros((size, len(bridge.members)))
    for i, (p, q) in enumerate(bridge.members):
        d = bridge.joints[q] - bridge.joints[p]
        e = d / hypot(*d) * sqrt(bridge.stiffness[i])
        G[2 * p : 2 * p + 2, i] = e / sqrt(bridge.masses[p])
        G[2 * q : 2 * q + 2, i] = -e / sqrt(bridge.masses[q])
    for row in (2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + 1):
        G[row] = 0
    return 2 / np.linalg.norm(G, 2)


if __name__ == "__main__":
    bridge = SimpleNamespace(
        joints=np.array([[0.0, 0.0], [3.0, 0.0], [6.0, 0.0], [1.5, 3.0], [4.5, 3.0]]),
        members=np.array([[0, 1], [1, 2], [3, 4], [0, 3], [2, 4], [1, 3], [1, 4]]),
        stiffness=np.full(7, 2e7),
        masses=np.full(5, 1000.0),
        gravity=9.81,
        pinned=0,
        roller=2,
    )
    print(heaviest(bridge), largest_dt(bridge))
