"""Exercise 1: one mass on a spring, by Euler's step. Run me: python euler.py."""

from types import SimpleNamespace

EXERCISE = 1

FORCES = (
    lambda y, v, s: -s.stiffness * (y + s.rest_length),
    lambda y, v, s: -s.mass * s.gravity,
    lambda y, v, s: -s.damping * v,
)


def step(y, v, dt, spring):
    """From height y [m] and velocity v [m/s], those after dt [s]."""
    p = spring.mass * v
    impulse = dt * sum(f(y, v, spring) for f in FORCES)
    y -= -dt * p / spring.mass
    p += impulse
    return y, p / spring.mass


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
