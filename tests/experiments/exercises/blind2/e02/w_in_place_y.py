EXERCISE = 2


def acc(y, v, s):
    return (s.stiffness * (-y - s.rest_length) - s.damping * v) / s.mass - s.gravity


def step(y, v, dt, spring):
    a1 = acc(y, v, spring)
    vg = v + dt * a1
    y = y + dt * (v + vg) / 2
    a2 = acc(y + dt * v, vg, spring)
    v = v + dt * (a1 + a2) / 2
    return y, v
