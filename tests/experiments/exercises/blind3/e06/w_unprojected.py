"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    T = U = G = 0.0
    for i in range(len(x)):
        T += 0.5 * string.masses[i] * (v[i] @ v[i])
        up = string.anchor if i == 0 else x[i - 1]
        stretch = np.linalg.norm(x[i] - up) - string.rest_lengths[i]
        U += 0.5 * string.stiffness[i] * stretch**2
        G += string.masses[i] * string.gravity * x[i, 1]
    return T, U, G


def power(x, v, string):
    """What damping adds to the energy [W]."""
    P = 0.0
    for i in range(len(x)):
        dv = v[i] if i == 0 else v[i] - v[i - 1]
        P -= string.damping[i] * (dv @ dv)
        P -= string.drag * (v[i] @ v[i])
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
