EXERCISE = 2


def rate(y, v, s):
    return v, (s.stiffness * (-y - s.rest_length) - s.damping * v) / s.mass - s.gravity


def step(y, v, dt, spring):
    k1 = rate(y, v, spring)
    k2 = rate(y + 2 / 3 * dt * k1[0], v + 2 / 3 * dt * k1[1], spring)
    y = y + dt * (k1[0] / 4 + 3 * k2[0] / 4)
    v = v + dt * (k1[1] / 4 + 3 * k2[1] / 4)
    return y, v
