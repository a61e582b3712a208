import numpy as np

EXERCISE = 7


class Barrier:
    def __init__(self, centre, radius):
        self.centre = centre
        self.radius = radius

    def contains(self, p):
        return np.hypot(*(p - self.centre)) <= self.radius

    def normal(self, p):
        out = p - self.centre
        return out / np.hypot(*out)

    def surface(self, p):
        return self.centre + self.normal(p) * self.radius

    def velocity(self, p, u):
        n = self.normal(p)
        t = np.array([n[1], -n[0]])
        speed = u.dot(n)
        if speed >= 0:
            return u
        return u.dot(t) * t


def push_out(x, v, circle):
    barrier = Barrier(circle.centre, circle.radius)
    positions, velocities = [], []
    for p, u in zip(x, v):
        if barrier.contains(p):
            velocities.append(barrier.velocity(p, u))
            positions.append(barrier.surface(p))
        else:
            positions.append(p)
            velocities.append(u)
    return np.array(positions), np.array(velocities)
