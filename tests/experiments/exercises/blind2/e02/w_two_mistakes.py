EXERCISE = 2


def acc(y, v, s):
    return (s.stiffness * (-y - s.rest_length) + s.damping * v) / s.mass - s.gravity


def step(y, v, dt, spring):
    a1 = acc(y, v, spring)
    yg, vg = y + dt * v, v + dt * a1
    a2 = acc(yg, vg, spring)
    return y + dt * (v + vg) / 2, v + dt * (a1 + a2) / 3
