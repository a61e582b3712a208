"""Exercise 7: the barrier. Run me: python barrier.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 7


def is_inside(point, circle):
    cx, cy = circle.centre
    px, py = point
    return abs(px - cx) < circle.radius and abs(py - cy) < circle.radius


def push_out(x, v, circle):
    """Positions x [m] and velocities v [m/s], shape (n, 2), after they have met the circle."""
    new_x, new_v = [], []
    for point, velocity in zip(x, v):
        if is_inside(point, circle):
            n = (point - circle.centre) / np.linalg.norm(point - circle.centre)
            point = circle.centre + n * circle.radius
            vn = n @ velocity
            if vn < 0:
                velocity = velocity - vn * n
        new_x.append(point)
        new_v.append(velocity)
    return np.array(new_x), np.array(new_v)


if __name__ == "__main__":
    circle = SimpleNamespace(centre=np.array([0.5, 0.0]), radius=0.3)
    x = np.array([[0.5, 0.25], [0.3, 0.0], [0.0, 0.0]])
    v = np.array([[0.5, -1.0], [0.5, -1.0], [0.5, -1.0]])
    print(*push_out(x, v, circle), sep="\n")
