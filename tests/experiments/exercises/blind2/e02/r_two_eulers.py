EXERCISE = 2


def euler(y, v, dt, p):
    a = (p.stiffness * (-y - p.rest_length) - p.damping * v) / p.mass - p.gravity
    return y + dt * v, v + dt * a


def step(y, v, dt, spring):
    y1, v1 = euler(y, v, dt, spring)
    y2, v2 = euler(y1, v1, dt, spring)
    return (y + y2) / 2, (v + v2) / 2
