"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    above = np.roll(x, 1, axis=0)
    above[0] = string.anchor
    l = np.sqrt(((x - above) ** 2).sum(1))
    e_kin = (string.masses[:, None] * v**2).sum() / 2
    e_spring = (string.stiffness * (l - string.rest_lengths) ** 2).sum() / 2
    e_weight = (string.masses * x[:, 1]).sum() * string.gravity
    return e_kin, e_spring, e_weight


def power(x, v, string):
    """What damping adds to the energy [W]."""
    above = np.roll(x, 1, axis=0)
    above[0] = string.anchor
    v_above = np.roll(v, 1, axis=0)
    d = x - above
    l = np.sqrt((d**2).sum(1))
    l_dot = ((v - v_above) * d).sum(1) / l
    return -(string.damping * l_dot**2).sum() - string.drag * (v**2).sum()


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
