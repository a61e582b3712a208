"""Exercise 2: one mass on a spring, by Heun's step. Run me: python heun.py."""

from types import SimpleNamespace

EXERCISE = 2


def acc(y, v, spring):
    stretch = -y - spring.rest_length
    return (spring.stiffness * stretch - spring.damping * v) / spring.mass - spring.gravity


def step(y, v, dt, spring):
    """From height y [m] and velocity v [m/s], those after dt [s]."""
    dy1, dv1 = v, acc(y, v, spring)
    y, v = y + dt * dy1, v + dt * dv1
    dy2, dv2 = v, acc(y, v, spring)
    y = y + dt * 0.5 * (dy1 + dy2)
    v = v + dt * 0.5 * (dv1 + dv2)
    return y, v


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
