"""Exercise 4 with complex numbers: sideways is real, upwards imaginary."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 4


def step(x, v, dt, string):
    """From positions x [m] and velocities v [m/s], shape (n, 2), those after dt [s]."""
    n = len(x)
    z0 = [complex(*row) for row in x]
    w0 = [complex(*row) for row in v]
    anchor = complex(*string.anchor)

    def accelerations(z, w):
        chain = [anchor, *z]
        link = [chain[i + 1] - chain[i] for i in range(n)]
        pull = [k * (abs(e) - l) * e / abs(e) for k, l, e in zip(string.stiffness, string.rest_lengths, link)]
        pull.append(0)
        return [(pull[i + 1] - pull[i] - string.drag * w[i]) / string.masses[i] - 1j * string.gravity for i in range(n)]

    a0 = accelerations(z0, w0)
    z1 = [z + dt * w for z, w in zip(z0, w0)]
    w1 = [w + dt * a for w, a in zip(w0, a0)]
    a1 = accelerations(z1, w1)
    z2 = [z0[i] + dt * (w0[i] + w1[i]) / 2 for i in range(n)]
    w2 = [w0[i] + dt * (a0[i] + a1[i]) / 2 for i in range(n)]
    pairs = lambda numbers: np.array([[q.real, q.imag] for q in numbers])
    return pairs(z2), pairs(w2)


if __name__ == "__main__":
    string = SimpleNamespace(
        masses=np.full(3, 0.05),
        stiffness=np.full(3, 50.0),
        rest_lengths=np.full(3, 0.15),
        drag=0.02,
        gravity=9.81,
        anchor=np.array([0.1, 0.2]),
    )
    x = string.anchor + np.array([[0.15, 0.0], [0.3, 0.0], [0.45, 0.0]])
    v = np.zeros((3, 2))
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   the last mass is at {x[-1]} m")
        x, v = step(x, v, 0.005, string)
