EXERCISE = 2


def acc(y, v, s):
    F = s.stiffness * (-y - s.rest_length) - s.damping * v - s.mass * s.gravity
    return F / s.mass


def step(y, v, dt, spring):
    a1 = acc(y, v, spring)
    yg = y + dt / 2 * v
    vg = v + dt / 2 * a1
    a2 = acc(yg, vg, spring)
    v_new = v + dt * a2
    y_new = y + dt * vg
    return y_new, v_new
