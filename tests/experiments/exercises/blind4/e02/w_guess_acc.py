"""Exercise 2: one mass on a spring, by Heun's step. Run me: python heun.py."""

from types import SimpleNamespace

EXERCISE = 2


def force(y, v, spring):
    return spring.stiffness * (-y - spring.rest_length) - spring.mass * spring.gravity - spring.damping * v


def step(y, v, dt, spring):
    """From height y [m] and velocity v [m/s], those after dt [s]."""
    a = force(y, v, spring) / spring.mass
    y_tilde = y + a * dt
    v_tilde = v + a * dt
    a_tilde = force(y_tilde, v_tilde, spring) / spring.mass
    y = y + dt * 0.5 * (v + v_tilde)
    v = v + dt * 0.5 * (a + a_tilde)
    return y, v


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
