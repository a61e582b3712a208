EXERCISE = 2


def euler(state, dt, s):
    y, v = state
    a = -s.gravity - s.damping / s.mass * v - s.stiffness / s.mass * (y + s.rest_length)
    return y + dt * v, v + dt * a


def step(y, v, dt, spring):
    # two steps of Euler, half-way back: the same as the mean of the slopes
    twice = euler(euler((y, v), dt, spring), dt, spring)
    return tuple((old + new) / 2 for old, new in zip((y, v), twice))
