"""Exercise 2: one mass on a spring, by Heun's step. Run me: python heun.py."""

from types import SimpleNamespace

EXERCISE = 2


class Heun:
    def __init__(self, spring):
        self.m = spring.mass
        self.k = spring.stiffness
        self.l = spring.rest_length
        self.c = spring.damping
        self.g = spring.gravity

    def acceleration(self, y, v):
        return (self.k * (-y - self.l) - self.c * v - self.m * self.g) / self.m

    def advance(self, y, v, dt):
        a1 = self.acceleration(y, v)
        ye, ve = y + dt * v, v + dt * a1
        a2 = self.acceleration(ye, ve)
        y_new = y + dt * (v + ve) / 2
        v_new = v + dt * a2
        return y_new, v_new


def step(y, v, dt, spring):
    """From height y [m] and velocity v [m/s], those after dt [s]."""
    return Heun(spring).advance(y, v, dt)


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
