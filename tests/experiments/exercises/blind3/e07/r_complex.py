"""Exercise 7: the barrier. Run me: python barrier.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    """Positions x [m] and velocities v [m/s], shape (n, 2), after they have met the circle."""
    centre = complex(circle.centre[0], circle.centre[1])
    x_new, v_new = x.copy(), v.copy()
    for i, (p, u) in enumerate(zip(x @ [1, 1j], v @ [1, 1j])):
        d = p - centre
        if abs(d) < circle.radius:
            e = d / abs(d)
            q = centre + circle.radius * e
            local = u * e.conjugate()  # real part: outwards
            u = complex(max(local.real, 0.0), local.imag) * e
            x_new[i] = q.real, q.imag
            v_new[i] = u.real, u.imag
    return x_new, v_new


if __name__ == "__main__":
    circle = SimpleNamespace(centre=np.array([0.5, 0.0]), radius=0.3)
    x = np.array([[0.5, 0.25], [0.3, 0.0], [0.0, 0.0]])
    v = np.array([[0.5, -1.0], [0.5, -1.0], [0.5, -1.0]])
    print(*push_out(x, v, circle), sep="\n")
