"""Exercise 1: one mass on a spring, by Euler's step. Run me: python euler.py."""

from types import SimpleNamespace

EXERCISE = 1


def acceleration(y, v, s):
    total = s.stiffness * (abs(y) - s.rest_length)
    total -= s.damping * v
    return total / s.mass - s.gravity


def step(y, v, dt, spring):
    """From height y [m] and velocity v [m/s], those after dt [s]."""
    a = acceleration(y, v, spring)
    # the formula from school: s = s0 + v t + 1/2 a t^2
    new_y = y + v * dt + a * dt ** 2 / 2
    new_v = v + a * dt
    return new_y, new_v


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
