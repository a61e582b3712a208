"""Exercise 7: the barrier. Run me: python barrier.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    """Positions x [m] and velocities v [m/s], shape (n, 2), after they have met the circle."""
    X = x.copy()
    V = v.copy()
    cx, cy = circle.centre
    for i in range(x.shape[0]):
        dx = x[i, 0] - cx
        dy = x[i, 1] - cy
        dist = (dx**2 + dy**2) ** 0.5
        if dist < circle.radius:
            n = x[i] / np.linalg.norm(x[i])
            X[i] = circle.centre + circle.radius * n
            inwards = V[i, 0] * n[0] + V[i, 1] * n[1]
            if inwards < 0:
                V[i, 0] -= inwards * n[0]
                V[i, 1] -= inwards * n[1]
    return X, V


if __name__ == "__main__":
    circle = SimpleNamespace(centre=np.array([0.5, 0.0]), radius=0.3)
    x = np.array([[0.5, 0.25], [0.3, 0.0], [0.0, 0.0]])
    v = np.array([[0.5, -1.0], [0.5, -1.0], [0.5, -1.0]])
    print(*push_out(x, v, circle), sep="\n")
