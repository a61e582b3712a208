"""Exercise 2: one mass on a spring, by Heun's step. Run me: python heun.py."""

from types import SimpleNamespace

EXERCISE = 2


def accel(y, v, spring):
    spring_up = spring.stiffness * (-y - spring.rest_length)
    return (spring_up - spring.mass * spring.gravity + spring.damping * v) / spring.mass


def step(y, v, dt, spring):
    """From height y [m] and velocity v [m/s], those after dt [s]."""
    a1 = accel(y, v, spring)
    v1 = v + dt * a1
    a2 = accel(y, v1, spring)
    y_new = y + dt * (v + v1) / 2
    v_new = v + dt * (a1 + a2) / 2
    return y_new, v_new


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
