EXERCISE = 2


def acc(y, v, s):
    F = s.stiffness * (-y - s.rest_length) - s.damping * v - s.mass * s.gravity
    return F / s.mass


def step(y, v, dt, spring):
    a1 = acc(y, v, spring)
    yg = y + dt * v
    vg = v + dt * a1
    a2 = acc(yg, vg, spring)
    v_new = v + dt * (a1 + a2) / 2
    y_new = y + dt * (v + v_new) / 2
    return y_new, v_new
