EXERCISE = 1


def step(y, v, dt, spring):
    s = spring
    acc = (s.stiffness * (-y - s.rest_length) - s.damping * v) / s.mass - s.gravity
    return v + dt * acc, y + dt * v
