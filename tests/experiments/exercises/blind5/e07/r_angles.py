"""Exercise 7: the barrier in polar coordinates. Run me: python barrier.py."""

import math
from types import SimpleNamespace

import numpy as np

EXERCISE = 7


def meet(place, velocity, centre, radius):
    rx, ry = place[0] - centre[0], place[1] - centre[1]
    if math.hypot(rx, ry) >= radius:
        return list(place), list(velocity)
    phi = math.atan2(ry, rx)
    c, s = math.cos(phi), math.sin(phi)
    # turn the velocity into the frame (outwards, along), clip, turn back
    outwards = max(c * velocity[0] + s * velocity[1], 0)
    along = c * velocity[1] - s * velocity[0]
    return (
        [centre[0] + radius * c, centre[1] + radius * s],
        [c * outwards - s * along, s * outwards + c * along],
    )


def push_out(x, v, circle):
    """Positions x [m] and velocities v [m/s], shape (n, 2), after they have met the circle."""
    met = [meet(p, w, circle.centre, circle.radius) for p, w in zip(x, v)]
    return np.array([m[0] for m in met]), np.array([m[1] for m in met])


if __name__ == "__main__":
    circle = SimpleNamespace(centre=np.array([0.5, 0.0]), radius=0.3)
    x = np.array([[0.5, 0.25], [0.3, 0.0], [0.0, 0.0]])
    v = np.array([[0.5, -1.0], [0.5, -1.0], [0.5, -1.0]])
    print(*push_out(x, v, circle), sep="\n")
