"""Exercise 2: one mass on a spring, by Heun's step. Run me: python heun.py."""

from types import SimpleNamespace

EXERCISE = 2


def acceleration(y, v, spring):
    up = spring.stiffness * (abs(y) - spring.rest_length)
    down = spring.mass * spring.gravity + spring.damping * v
    return (up - down) / spring.mass


def step(y, v, dt, spring):
    """From height y [m] and velocity v [m/s], those after dt [s]."""
    # slope here
    dy1 = v
    dv1 = acceleration(y, v, spring)
    # guess
    y_g = y + dt * dy1
    v_g = v + dt * dv1
    # slope at the guess
    dy2 = v
    dv2 = acceleration(y_g, v_g, spring)
    # step
    return y + dt * (dy1 + dy2) / 2, v + dt * (dv1 + dv2) / 2


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
