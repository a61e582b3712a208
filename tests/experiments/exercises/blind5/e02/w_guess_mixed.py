"""Exercise 2: one mass on a spring, by Heun's step. Run me: python heun.py."""

from types import SimpleNamespace

EXERCISE = 2


def net_force(y, v, s):
    spring_force = s.stiffness * (-y - s.rest_length)
    damping_force = -s.damping * v
    weight = -s.mass * s.gravity
    return spring_force + damping_force + weight


def step(y, v, dt, spring):
    """From height y [m] and velocity v [m/s], those after dt [s]."""
    m = spring.mass
    slope_v = net_force(y, v, spring) / m
    guess_y = y + dt * v
    guess_v = v + dt * net_force(guess_y, v, spring) / m
    guess_slope_v = net_force(guess_y, guess_v, spring) / m
    y += dt / 2 * (v + guess_v)
    v += dt / 2 * (slope_v + guess_slope_v)
    return y, v


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
