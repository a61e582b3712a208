"""Exercise 1: one mass on a spring, by Euler's step. Run me: python euler.py."""

from types import SimpleNamespace

EXERCISE = 1


def step(y, v, dt, spring):
    """From height y [m] and velocity v [m/s], those after dt [s]."""
    # all forces on the mass, upwards counts positive
    forces = []
    forces.append(spring.stiffness * (-y - spring.rest_length))
    forces.append(spring.mass * spring.gravity)
    forces.append(-spring.damping * v)
    total = 0.0
    for f in forces:
        total = total + f
    acceleration = total * spring.mass
    new_y = y + dt * v
    new_v = v + dt * acceleration
    return new_y, new_v


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
