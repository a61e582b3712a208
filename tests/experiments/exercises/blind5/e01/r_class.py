"""Exercise 1: one mass on a spring, by Euler's step. Run me: python euler.py."""

from types import SimpleNamespace

EXERCISE = 1


class Oscillator:
    def __init__(self, spring, y, v):
        self.spring = spring
        self.y = y
        self.v = v

    @property
    def elongation(self):
        return -self.y - self.spring.rest_length

    def total_force(self):
        s = self.spring
        return s.stiffness * self.elongation - s.mass * s.gravity - s.damping * self.v

    def advance(self, dt):
        a = self.total_force() / self.spring.mass
        self.y, self.v = self.y + dt * self.v, self.v + dt * a


def step(y, v, dt, spring):
    """From height y [m] and velocity v [m/s], those after dt [s]."""
    o = Oscillator(spring, y, v)
    o.advance(dt)
    return o.y, o.v


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
