import numpy as np

EXERCISE = 3


class Node:
    def __init__(self, position, velocity, mass):
        self.position = position
        self.velocity = velocity
        self.mass = mass
        self.force = np.zeros(2)


class Link:
    def __init__(self, upper, lower, stiffness, rest):
        self.upper, self.lower = upper, lower
        self.stiffness, self.rest = stiffness, rest

    def act(self):
        gap = self.lower.position - self.upper.position
        length = np.hypot(*gap)
        tension = self.stiffness * (length - self.rest) * gap / length
        self.upper.force += tension
        self.lower.force -= tension


def forces(x, v, string):
    anchor = Node(string.anchor, np.zeros(2), 1.0)
    nodes = [Node(*args) for args in zip(x, v, string.masses)]
    above = [anchor, *nodes]
    links = [Link(*args) for args in zip(above, nodes, string.stiffness, string.rest_lengths)]
    for node in nodes:
        node.force += [0.0, -node.mass * string.gravity]
        node.force -= string.drag * node.velocity
    for link in links:
        link.act()
    return np.array([node.force for node in nodes])
