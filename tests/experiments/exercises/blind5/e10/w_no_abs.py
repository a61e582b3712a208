"""Exercise 10: the bridge. Run me: python bridge.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 10


def unit(bridge, a, b):
    d = bridge.joints[b] - bridge.joints[a]
    return d / np.sqrt(d @ d)


def heaviest(bridge):
    """The number of the member with the largest force, and the force [N], positive in tension."""
    equations = []
    right = []
    m = len(bridge.members)
    for joint in range(len(bridge.joints)):
        for axis in (0, 1):
            row = [0.0] * (m + 3)
            for number, (a, b) in enumerate(bridge.members):
                if joint == a:
                    row[number] = unit(bridge, a, b)[axis]
                elif joint == b:
                    row[number] = unit(bridge, b, a)[axis]
            if joint == bridge.pinned:
                row[m + axis] = 1.0
            if joint == bridge.roller and axis == 1:
                row[m + 2] = 1.0
            equations.append(row)
            right.append(bridge.masses[joint] * bridge.gravity if axis == 1 else 0.0)
    forces = np.linalg.solve(np.array(equations), np.array(right))[:m]
    best = int(np.argmax(forces))
    return best, float(forces[best])


def largest_dt(bridge):
    """The largest stable dt [s] of kick-drift."""
    n = len(bridge.joints)
    K = np.zeros((n, 2, n, 2))
    for (a, b), k in zip(bridge.members, bridge.stiffness):
        e = unit(bridge, a, b)
        kk = k * e[:, None] * e[None, :]
        K[a, :, a, :] += kk
        K[b, :, b, :] += kk
        K[a, :, b, :] -= kk
        K[b, :, a, :] -= kk
    free = [(i, c) for i in range(n) for c in (0, 1) if i != bridge.pinned and not (i == bridge.roller and c == 1)]
    D = np.array([[K[i, c, p, q] / np.sqrt(bridge.masses[i] * bridge.masses[p]) for p, q in free] for i, c in free])
    return float(2 / np.sqrt(np.linalg.eigvalsh(D)[-1]))


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
