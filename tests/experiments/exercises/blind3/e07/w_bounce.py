"""Exercise 7: the barrier. Run me: python barrier.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 7


def push_out(x, v, circle):
    xs, vs = [], []
    for p, u in zip(x, v):
        away = p - circle.centre
        depth = circle.radius - np.linalg.norm(away)
        if depth > 0:
            away = away / np.linalg.norm(away)
            p = p + depth * away
            inward = np.dot(u, away)
            if inward < 0:
                u = u - 2 * inward * away
        xs.append(p)
        vs.append(u)
    return np.array(xs), np.array(vs)


if __name__ == "__main__":
    circle = SimpleNamespace(centre=np.array([0.5, 0.0]), radius=0.3)
    x = np.array([[0.5, 0.25], [0.3, 0.0], [0.0, 0.0]])
    v = np.array([[0.5, -1.0], [0.5, -1.0], [0.5, -1.0]])
    print(*push_out(x, v, circle), sep="\n")
