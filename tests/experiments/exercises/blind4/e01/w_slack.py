"""Exercise 1: one mass on a spring, by Euler's step. Run me: python euler.py."""

from types import SimpleNamespace

EXERCISE = 1


class Mass:
    def __init__(self, y, v, spring):
        self.y, self.v, self.s = y, v, spring

    def force(self):
        # a spring can only pull
        ext = max(0.0, -self.y - self.s.rest_length)
        return self.s.stiffness * ext - self.s.damping * self.v - self.s.mass * self.s.gravity

    def euler(self, dt):
        a = self.force() / self.s.mass
        self.y += self.v * dt
        self.v += a * dt


def step(y, v, dt, spring):
    """From height y [m] and velocity v [m/s], those after dt [s]."""
    m = Mass(y, v, spring)
    m.euler(dt)
    return m.y, m.v


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
