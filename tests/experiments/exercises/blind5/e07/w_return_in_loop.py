"""Exercise 7: the barrier. Run me: python barrier.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    """Positions x [m] and velocities v [m/s], shape (n, 2), after they have met the circle."""
    xs = x.copy()
    vs = v.copy()
    C = circle.centre
    R = circle.radius
    for i in range(x.shape[0]):
        dx = xs[i, 0] - C[0]
        dy = xs[i, 1] - C[1]
        r = (dx ** 2 + dy ** 2) ** 0.5
        if r < R:
            nx, ny = dx / r, dy / r
            xs[i] = [C[0] + R * nx, C[1] + R * ny]
            vn = vs[i, 0] * nx + vs[i, 1] * ny
            if vn < 0:
                vs[i, 0] -= vn * nx
                vs[i, 1] -= vn * ny
        return xs, vs


if __name__ == "__main__":
    circle = SimpleNamespace(centre=np.array([0.5, 0.0]), radius=0.3)
    x = np.array([[0.5, 0.25], [0.3, 0.0], [0.0, 0.0]])
    v = np.array([[0.5, -1.0], [0.5, -1.0], [0.5, -1.0]])
    print(*push_out(x, v, circle), sep="\n")
