EXERCISE = 2


def slope(y, v, spring):
    force = spring.stiffness * (-y - spring.rest_length) - spring.mass * spring.gravity - spring.damping * v
    return v, force / spring.mass


def step(y, v, dt, spring):
    y1, v1 = slope(y, v, spring)
    y2, v2 = slope(y + dt * y1, v + dt * v1, spring)
    return y + dt * (y1 + y2) / 2, v + dt * (v1 + v2) / 2
