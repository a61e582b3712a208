"""Exercise 2: one mass on a spring, by Heun's step. Run me: python heun.py."""

from types import SimpleNamespace

EXERCISE = 2


class State:
    def __init__(self, y, v):
        self.y, self.v = y, v

    def __add__(self, other):
        return State(self.y + other.y, self.v + other.v)

    def __mul__(self, number):
        return State(self.y * number, self.v * number)

    def derivative(self, sp):
        force = sp.stiffness * (-self.y - sp.rest_length)
        force += -sp.damping * self.v
        force += -sp.mass * sp.gravity
        return State(self.v, force / sp.mass)


def step(y, v, dt, spring):
    """From height y [m] and velocity v [m/s], those after dt [s]."""
    s = State(y, v)
    k1 = s.derivative(spring)
    k2 = (s + k1 * (dt / 2)).derivative(spring)
    s = s + (k1 + k2) * (dt / 2)
    return s.y, s.v


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
