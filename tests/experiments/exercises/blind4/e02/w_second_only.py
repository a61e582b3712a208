"""Exercise 2: one mass on a spring, by Heun's step. Run me: python heun.py."""

from types import SimpleNamespace

EXERCISE = 2


def step(y, v, dt, spring):
    """From height y [m] and velocity v [m/s], those after dt [s]."""

    def a(p, q):
        return (-spring.stiffness * (p + spring.rest_length) - spring.damping * q) / spring.mass - spring.gravity

    a0 = a(y, v)
    p = y + v * dt
    q = v + a0 * dt
    a1 = a(p, q)
    v_new = v + a1 * dt
    y_new = y + (v + q) / 2 * dt
    return y_new, v_new


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
