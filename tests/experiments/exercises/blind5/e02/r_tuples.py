"""Exercise 2: one mass on a spring, by Heun's step. Run me: python heun.py."""

from types import SimpleNamespace

EXERCISE = 2


def heun(f, state, h):
    """One step of Heun for any list of numbers."""
    k1 = f(state)
    k2 = f([s + h * k for s, k in zip(state, k1)])
    return tuple(s + h * (a + b) / 2 for s, a, b in zip(state, k1, k2))


def step(y, v, dt, spring):
    """From height y [m] and velocity v [m/s], those after dt [s]."""

    def slope(state):
        height, speed = state
        pull = spring.stiffness * (-height - spring.rest_length)
        return speed, (pull - spring.damping * speed) / spring.mass - spring.gravity

    return heun(slope, (y, v), dt)


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
