"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    E_kin = 0
    E_spring = 0
    E_pot = 0
    for i in range(len(x)):
        speed2 = sum(v[i]) ** 2
        E_kin += 0.5 * string.masses[i] * speed2
        if i == 0:
            l = np.linalg.norm(x[0] - string.anchor)
        else:
            l = np.linalg.norm(x[i] - x[i - 1])
        E_spring += 0.5 * string.stiffness[i] * (l - string.rest_lengths[i]) ** 2
        E_pot += string.masses[i] * string.gravity * x[i, 1]
    return E_kin, E_spring, E_pot


def power(x, v, string):
    """What damping adds to the energy [W]."""
    P = 0
    for i in range(len(x)):
        if i == 0:
            d, dv = x[0] - string.anchor, v[0]
        else:
            d, dv = x[i] - x[i - 1], v[i] - v[i - 1]
        rate = np.dot(d, dv) / np.linalg.norm(d)
        P -= string.damping[i] * rate * rate
        P -= string.drag * np.dot(v[i], v[i])
    return P


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
