"""Exercise 2: one mass on a spring, by Heun's step. Run me: python heun.py."""

from types import SimpleNamespace

EXERCISE = 2


def slope(y, v, s):
    ext = -y - s.rest_length
    return v, s.stiffness / s.mass * ext - s.damping / s.mass * v - s.gravity


def step(y, v, dt, spring):
    """From height y [m] and velocity v [m/s], those after dt [s]."""
    dy1, dv1 = slope(y, v, spring)
    yg, vg = y + dt * dy1, v + dt * dv1
    dy2, dv2 = slope(yg, vg, spring)
    # the guess already has one whole slope in it: replace half of it
    yg += 0.5 * dt * (dy2 - dy1)
    vg += 0.5 * dt * (dv2 - dv1)
    return yg, vg


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
