EXERCISE = 2


def a(y, v, s):
    return (s.stiffness * (-y - s.rest_length) - s.mass * s.gravity - s.damping * v) / s.mass


def step(y, v, dt, spring):
    yg, vg = y + dt * v, v + dt * a(y, v, spring)
    slope_y = 0.5 * (v + vg)
    slope_v = 0.5 * (a(y, v, spring) + a(yg, vg, spring))
    return yg + dt * slope_y, vg + dt * slope_v
