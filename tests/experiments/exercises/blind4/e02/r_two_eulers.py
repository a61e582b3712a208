"""Exercise 2: one mass on a spring, by Heun's step. Run me: python heun.py."""

from types import SimpleNamespace

EXERCISE = 2


def euler(y, v, dt, spring):
    a = (spring.stiffness * (-y - spring.rest_length) - spring.damping * v) / spring.mass - spring.gravity
    return y + dt * v, v + dt * a


def step(y, v, dt, spring):
    """Heun = mean of where I am and where two Euler steps would take me."""
    y1, v1 = euler(y, v, dt, spring)
    y2, v2 = euler(y1, v1, dt, spring)
    return (y + y2) / 2, (v + v2) / 2


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
