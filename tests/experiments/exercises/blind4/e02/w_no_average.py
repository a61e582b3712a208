"""Exercise 2: one mass on a spring, by Heun's step. Run me: python heun.py."""

from types import SimpleNamespace

EXERCISE = 2


def acc(y, v, s):
    return (s.stiffness * (-y - s.rest_length) - s.mass * s.gravity - s.damping * v) / s.mass


def step(y, v, dt, spring):
    """From height y [m] and velocity v [m/s], those after dt [s]."""
    a_here = acc(y, v, spring)
    yg = y + v * dt
    vg = v + a_here * dt
    a_there = acc(yg, vg, spring)
    y_next = y + 0.5 * (v + vg) * dt
    v_next = v + (a_here + a_there) * dt
    return y_next, v_next


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
