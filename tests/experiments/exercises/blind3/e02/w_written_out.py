"""Exercise 2: one mass on a spring, by Heun's step. Run me: python heun.py."""

from types import SimpleNamespace

EXERCISE = 2


def step(y, v, dt, spring):
    m = spring.mass
    k = spring.stiffness
    L = spring.rest_length
    c = spring.damping
    g = spring.gravity

    # slope here
    ky1 = v
    kv1 = (k * (-y - L) - c * v - m * g) / m
    # guess
    yp = y + ky1 * dt
    vp = v + kv1 * dt
    # slope there
    ky2 = vp
    kv2 = (k * (-yp + L) - c * vp - m * g) / m
    # average
    y2 = y + dt * (ky1 + ky2) / 2
    v2 = v + dt * (kv1 + kv2) / 2
    return y2, v2


if __name__ == "__main__":
    spring = SimpleNamespace(mass=0.05, stiffness=50.0, rest_length=0.15, damping=0.0, gravity=9.81)
    y, v = -0.2, 0.0
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   y = {y:.5f} m   v = {v:.5f} m/s")
        y, v = step(y, v, 0.005, spring)
