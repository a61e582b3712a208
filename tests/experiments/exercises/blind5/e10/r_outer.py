"""Exercise 10: the bridge. Run me: python bridge.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 10


def compatibility(bridge):
    """B: row i takes what all joints move by (2j numbers) to what member i gets longer by."""
    j, m = len(bridge.joints), len(bridge.members)
    B = np.zeros((m, j, 2))
    first, second = bridge.members.T
    d = bridge.joints[second] - bridge.joints[first]
    e = d / np.linalg.norm(d, axis=1, keepdims=True)
    number = np.arange(m)
    B[number, second] = e
    B[number, first] = -e
    return B.reshape(m, 2 * j)


def free(bridge):
    held = [2 * bridge.pinned, 2 * bridge.pinned + 1, 2 * bridge.roller + 1]
    return np.delete(np.arange(2 * len(bridge.joints)), held)


def heaviest(bridge):
    """The number of the member with the largest force, and the force [N], positive in tension."""
    # Where nothing holds, B^T t = load; what the supports give need not be known.
    load = np.zeros((len(bridge.joints), 2))
    load[:, 1] = -bridge.masses * bridge.gravity
    keep = free(bridge)
    t = np.linalg.solve(compatibility(bridge).T[keep], load.ravel()[keep])
    i = int(np.abs(t).argmax())
    return i, float(t[i])


def largest_dt(bridge):
    """The largest stable dt [s] of kick-drift."""
    keep = free(bridge)
    B = compatibility(bridge)[:, keep]
    root_m = np.sqrt(np.repeat(bridge.masses, 2)[keep])
    # K = B^T k B, so w is the largest singular value of k^1/2 B m^-1/2
    w = np.linalg.svd(np.sqrt(bridge.stiffness)[:, None] * B / root_m, compute_uv=False)[0]
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
