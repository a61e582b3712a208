"""Exercise 1: one mass on a spring, by Euler's step. Run me: python euler.py."""

from types import SimpleNamespace

EXERCISE = 1


def step(y, v, dt, spring):
    k, L0, c = spring.stiffness, spring.rest_length, spring.damping
    f_spring = k * (-y - L0)
    f_weight = -spring.gravity
    f_damping = -c * v
    a = (f_spring + f_weight + f_damping) / spring.mass
    return y + dt * v, v + dt * a


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
