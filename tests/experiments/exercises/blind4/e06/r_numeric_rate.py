"""Exercise 6: energy and damping. Run me: python energy.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 6


def lengths(x, anchor):
    p = np.concatenate([anchor[None], x])
    d = p[1:] - p[:-1]
    return np.sqrt(d[:, 0] ** 2 + d[:, 1] ** 2)


def energy(x, v, string):
    """Kinetic, elastic and gravitational energy [J]."""
    stretch = lengths(x, string.anchor) - string.rest_lengths
    terms = (
        string.masses * (v**2).sum(axis=1) / 2,
        string.stiffness * stretch * stretch / 2,
        string.masses * string.gravity * x[:, 1],
    )
    return tuple(float(t.sum()) for t in terms)


def power(x, v, string):
    """What damping adds to the energy [W]."""
    # derivative of the length by time, complex step: exact to rounding
    h = 1e-20
    rate = lengths(x + 1j * h * v, string.anchor).imag / h
    springs = string.damping * rate**2
    drag = string.drag * (v**2).sum()
    return -(springs.sum() + drag)


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
