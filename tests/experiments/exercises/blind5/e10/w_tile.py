"""Exercise 10: the bridge. Run me: python bridge.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 10


class Truss:
    def __init__(self, bridge):
        self.bridge = bridge
        self.size = 2 * len(bridge.joints)
        self.columns = []
        for a, b in bridge.members:
            column = np.zeros(self.size)
            along = bridge.joints[b] - bridge.joints[a]
            along = along / np.linalg.norm(along)
            column[[2 * a, 2 * a + 1]] = along
            column[[2 * b, 2 * b + 1]] = -along
            self.columns.append(column)
        self.held = [2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + 1]
        self.moving = [i for i in range(self.size) if i not in self.held]

    def forces(self):
        supports = [np.eye(self.size)[i] for i in self.held]
        load = np.zeros(self.size)
        load[1::2] = -self.bridge.masses * self.bridge.gravity
        return np.linalg.solve(np.column_stack(self.columns + supports), -load)[:len(self.columns)]

    def frequency(self):
        K = sum(k * np.outer(c, c) for k, c in zip(self.bridge.stiffness, self.columns))
        M = np.diag(np.tile(self.bridge.masses, 2))
        K = K[self.moving][:, self.moving]
        M = M[self.moving][:, self.moving]
        return np.sqrt(np.linalg.eigvals(np.linalg.inv(M) @ K).real.max())


def heaviest(bridge):
    """The number of the member with the largest force, and the force [N], positive in tension."""
    f = Truss(bridge).forces()
    i = max(range(len(f)), key=lambda k: abs(f[k]))
    return i, float(f[i])


def largest_dt(bridge):
    """The largest stable dt [s] of kick-drift."""
    return float(2 / Truss(bridge).frequency())


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
