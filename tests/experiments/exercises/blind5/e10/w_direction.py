"""Exercise 10: the bridge. Run me: python bridge.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 10


def heaviest(bridge):
    """The number of the member with the largest force, and the force [N], positive in tension."""
    n_joints = bridge.joints.shape[0]
    n_members = bridge.members.shape[0]
    matrix = np.zeros((2 * n_joints, n_members + 3))
    vector = np.zeros(2 * n_joints)

    for k in range(n_members):
        i, j = bridge.members[k]
        dx, dy = bridge.joints[j] - bridge.joints[i]
        matrix[2 * i, k] = dx
        matrix[2 * i + 1, k] = dy
        matrix[2 * j, k] = -dx
        matrix[2 * j + 1, k] = -dy

    matrix[2 * bridge.pinned, -3] = 1
    matrix[2 * bridge.pinned + 1, -2] = 1
    matrix[2 * bridge.roller + 1, -1] = 1
    vector[1::2] = bridge.masses * bridge.gravity

    x = np.linalg.solve(matrix, vector)
    forces = x[:n_members]
    which = int(np.argmax(abs(forces)))
    return which, float(forces[which])


def largest_dt(bridge):
    """The largest stable dt [s] of kick-drift."""
    n = 2 * bridge.joints.shape[0]
    stiff = np.zeros((n, n))
    for (i, j), k in zip(bridge.members, bridge.stiffness):
        dx, dy = bridge.joints[j] - bridge.joints[i]
        l = np.hypot(dx, dy)
        c, s = dx / l, dy / l
        T = np.array([-c, -s, c, s])
        dofs = [2 * i, 2 * i + 1, 2 * j, 2 * j + 1]
        stiff[np.ix_(dofs, dofs)] += k * np.outer(T, T)
    ok = np.ones(n, dtype=bool)
    ok[[2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + 1]] = False
    m = np.repeat(bridge.masses, 2)[ok]
    w = np.sqrt(max(np.linalg.eigvals(stiff[ok][:, ok] / m[:, None]).real))
    return float(2 / w)


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
