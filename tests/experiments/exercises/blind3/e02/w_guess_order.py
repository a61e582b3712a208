"""Exercise 2: one mass on a spring, by Heun's step. Run me: python heun.py."""

from types import SimpleNamespace

EXERCISE = 2


def step(y, v, dt, spring):
    """From height y [m] and velocity v [m/s], those after dt [s]."""

    def a(yy, vv):
        f = -spring.stiffness * (yy + spring.rest_length)
        f -= spring.damping * vv
        f -= spring.gravity * spring.mass
        return f / spring.mass

    a0 = a(y, v)
    v1 = v + dt * a0
    y1 = y + dt * v1
    a1 = a(y1, v1)
    y = y + dt / 2 * (v + v1)
    v = v + dt / 2 * (a0 + a1)
    return y, v


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
