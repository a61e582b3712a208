"""Exercise 2: one mass on a spring, by Heun's step. Run me: python heun.py."""

from types import SimpleNamespace

EXERCISE = 2


def slopes(state, spring):
    y, v = state
    stretch = -y - spring.rest_length
    a = spring.stiffness * stretch / spring.mass - spring.damping * v / spring.mass - spring.gravity
    return (v, a)


def step(y, v, dt, spring):
    """From height y [m] and velocity v [m/s], those after dt [s]."""
    start = (y, v)
    first = slopes(start, spring)
    guess = tuple(q + dt * k for q, k in zip(start, first))
    second = slopes(guess, spring)
    mean = [k + l for k, l in zip(first, second)]
    y, v = (q + dt * k for q, k in zip(start, mean))
    return y, v


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
