"""Exercise 10: the bridge. Run me: python bridge.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 10


def heaviest(bridge):
    """The number of the member with the largest force, and the force [N], positive in tension."""
    X = bridge.joints
    J = len(X)
    M = len(bridge.members)
    matrix = []
    rhs = []
    for joint in range(J):
        row_x = [0.0] * (M + 3)
        row_y = [0.0] * (M + 3)
        for number, (a, b) in enumerate(bridge.members):
            if joint in (a, b):
                other = b if joint == a else a
                dx, dy = X[other] - X[joint]
                length = np.hypot(dx, dy)
                row_x[number] = dx / length
                row_y[number] = dy / length
        if joint == bridge.pinned:
            row_x[M] = 1.0
            row_y[M + 1] = 1.0
        if joint == bridge.roller:
            row_y[M + 2] = 1.0
        matrix += [row_x, row_y]
        rhs += [0.0, bridge.masses[joint] * bridge.gravity]
    result = np.linalg.solve(np.array(matrix), np.array(rhs))
    best = max(range(M), key=lambda i: abs(result[i]))
    return best, result[best]


def largest_dt(bridge):
    """The largest stable dt [s] of kick-drift."""
    X = bridge.joints
    J = len(X)
    K = np.zeros((2 * J, 2 * J))
    for (a, b), k in zip(bridge.members, bridge.stiffness):
        e = (X[b] - X[a]) / np.linalg.norm(X[b] - X[a])
        block = k * np.outer(e, e)
        K[2 * a : 2 * a + 2, 2 * a : 2 * a + 2] += block
        K[2 * b : 2 * b + 2, 2 * b : 2 * b + 2] += block
        K[2 * a : 2 * a + 2, 2 * b : 2 * b + 2] -= block
        K[2 * b : 2 * b + 2, 2 * a : 2 * a + 2] -= block
    free = np.ones(2 * J, dtype=bool)
    free[[2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + 1]] = False
    inverse_mass = np.diag(1 / np.repeat(bridge.masses, 2)[free])
    w = max(np.linalg.eigvals(inverse_mass @ K[free][:, free]).real)
    return 2 / w


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
