import numpy as np

EXERCISE = 10


class Member:
    def __init__(self, number, ends, joints, k):
        self.number, self.k = number, k
        self.a, self.b = ends
        gap = joints[self.b] - joints[self.a]
        self.direction = gap / np.hypot(*gap)

    def matrix(self):
        return self.k * np.outer(self.direction, self.direction)


class Truss:
    def __init__(self, bridge):
        self.bridge = bridge
        self.n = len(bridge.joints)
        self.members = [Member(i, ends, bridge.joints, bridge.stiffness[i]) for i, ends in enumerate(bridge.members)]

    def equilibrium(self):
        columns = []
        for member in self.members:
            column = np.zeros((self.n, 2))
            column[member.a] += member.direction
            column[member.b] -= member.direction
            columns.append(column.ravel())
        for joint, way in self.supports():
            column = np.zeros((self.n, 2))
            column[joint, way] = 1.0
            columns.append(column.ravel())
        return np.array(columns).T

    def supports(self):
        return [(self.bridge.pinned, 0), (self.bridge.pinned, 1), (self.bridge.roller, 1)]

    def weights(self):
        w = np.zeros((self.n, 2))
        w[:, 1] = -self.bridge.masses * self.bridge.gravity
        return w.ravel()

    def tensions(self):
        return np.linalg.solve(self.equilibrium(), -self.weights())[: len(self.members)]

    def frequencies(self):
        K = np.zeros((self.n, 2, self.n, 2))
        for m in self.members:
            K[m.a, :, m.a, :] += m.matrix()
            K[m.b, :, m.b, :] += m.matrix()
            K[m.a, :, m.b, :] -= m.matrix()
            K[m.b, :, m.a, :] -= m.matrix()
        K = K.reshape(2 * self.n, 2 * self.n)
        root = np.sqrt(np.repeat(self.bridge.masses, 2))
        D = K / np.outer(root, root)
        held = [2 * joint + way for joint, way in self.supports()]
        D = np.delete(np.delete(D, held, axis=0), held, axis=1)
        return np.sqrt(np.linalg.eigvalsh(D))


def heaviest(bridge):
    tensions = Truss(bridge).tensions()
    number = max(range(len(tensions)), key=lambda i: abs(tensions[i]))
    return number, tensions[number]


def largest_dt(bridge):
    return 2 / Truss(bridge).frequencies().max()
