"""Exercise 10: the bridge. Run me: python bridge.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 10


def geometry(bridge):
    P = bridge.joints[:, 0] + 1j * bridge.joints[:, 1]
    a, b = np.array(bridge.members).T
    u = (P[b] - P[a]) / abs(P[b] - P[a])
    pull = np.zeros((len(P), len(u)), dtype=complex)
    pull[a, range(len(u))] += u
    pull[b, range(len(u))] -= u
    sideways = [i for i in range(len(P)) if i != bridge.pinned]
    upwards = [i for i in sideways if i != bridge.roller]
    equations = np.concatenate([pull.real[sideways], pull.imag[upwards]])
    return equations, sideways, upwards


def heaviest(bridge):
    """The number of the member with the largest force, and the force [N], positive in tension."""
    equations, sideways, upwards = geometry(bridge)
    right = np.concatenate([np.zeros(len(sideways)), bridge.gravity * bridge.masses[upwards]])
    T = np.linalg.solve(equations, right)
    ranked = sorted(enumerate(T), key=lambda item: -abs(item[1]))
    return ranked[0]


def largest_dt(bridge):
    """The largest stable dt [s] of kick-drift."""
    E, sideways, upwards = geometry(bridge)
    m = bridge.masses[sideways + upwards]
    H = E / np.sqrt(m)[:, None] * np.sqrt(bridge.stiffness)
    return 2 / np.linalg.norm(H, 2)


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
