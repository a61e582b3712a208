"""Exercise 2: one mass on a spring, by Heun's step. Run me: python heun.py."""

from types import SimpleNamespace

EXERCISE = 2


def step(y, v, dt, spring):
    """From height y [m] and velocity v [m/s], those after dt [s]."""
    k, L, m, c, g = spring.stiffness, spring.rest_length, spring.mass, spring.damping, spring.gravity

    a1 = (k * (-y - L) - c * v) / m - g
    y_guess = y + dt * v
    v_guess = v + dt * a1
    a2 = (k * (-y_guess - L) - c * v) / m - g

    return y + dt * (v + v_guess) / 2, v + dt * (a1 + a2) / 2


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
