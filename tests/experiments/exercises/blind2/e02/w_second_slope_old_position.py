EXERCISE = 2


def acc(y, v, s):
    return (s.stiffness * (-y - s.rest_length) - s.damping * v) / s.mass - s.gravity


def step(y, v, dt, spring):
    a0 = acc(y, v, spring)
    y_guess = y + dt * v
    v_guess = v + dt * a0
    a1 = acc(y, v_guess, spring)
    y_new = y + dt * (v + v_guess) / 2
    v_new = v + dt * (a0 + a1) / 2
    return y_new, v_new
