EXERCISE = 2


def accel(y, v, spring):
    return -spring.gravity + (spring.stiffness * (-y - spring.rest_length) - spring.damping * v) / spring.mass


def step(y, v, dt, spring):
    a1 = accel(y, v, spring)
    v2 = v + a1 * dt
    y2 = y + v2 * dt
    a2 = accel(y2, v2, spring)
    return y + (v + v2) / 2 * dt, v + (a1 + a2) / 2 * dt
