"""Exercise 2: one mass on a spring, by Heun's step. Run me: python heun.py."""

from types import SimpleNamespace

EXERCISE = 2


def accel(y, v, spring):
    F = spring.stiffness * (-y - spring.rest_length)
    F -= spring.mass * spring.gravity
    F += spring.damping * v
    return F / spring.mass


def step(y, v, dt, spring):
    """From height y [m] and velocity v [m/s], those after dt [s]."""
    a1 = accel(y, v, spring)
    vE = v + a1 * dt
    yE = y + v * dt
    a2 = accel(yE, vE, spring)
    v_end = v + 0.5 * dt * (a1 + a2)
    y_end = y + dt * (v + vE)
    return y_end, v_end


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
