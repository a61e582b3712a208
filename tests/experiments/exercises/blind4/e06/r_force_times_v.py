"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    kin = el = pot = 0.0
    hold = string.anchor
    for i in range(len(x)):
        kin += string.masses[i] * (v[i, 0] ** 2 + v[i, 1] ** 2) / 2
        el += string.stiffness[i] * (np.hypot(*(x[i] - hold)) - string.rest_lengths[i]) ** 2 / 2
        pot += string.masses[i] * string.gravity * x[i, 1]
        hold = x[i]
    return kin, el, pot


def damping_forces(x, v, string):
    f = -string.drag * v
    for i in range(len(x)):
        e = x[i] - (x[i - 1] if i else string.anchor)
        e = e / np.sqrt(e @ e)
        rel = v[i] - v[i - 1] if i else v[0]
        push = string.damping[i] * (rel @ e) * e
        f[i] -= push
        if i:
            f[i - 1] += push
    return f


def power(x, v, string):
    """What damping adds to the energy [W]."""
    return float(np.sum(damping_forces(x, v, string) * v))


if __name__ == "__main__":
    string = SimpleNamespace(
        masses=np.full(3, 0.05),
        stiffness=np.full(3, 50.0),
        rest_lengths=np.full(3, 0.15),
        damping=np.full(3, 0.05),
        drag=0.02,
        gravity=9.81,
        anchor=np.array([0.1, 0.2]),
    )
    x = string.anchor + np.array([[0.15, 0.0], [0.3, 0.0], [0.45, 0.0]])
    v = np.zeros((3, 2))
    v[:, 1] = -1.0
    print(energy(x, v, string), power(x, v, string))
