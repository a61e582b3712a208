EXERCISE = 2


def slope(y, v, spring):
    f = spring.stiffness * (-y - spring.rest_length)
    f -= spring.mass * spring.gravity
    f -= spring.damping * v
    return v, f / spring.mass


def step(y, v, dt, spring):
    dy1, dv1 = slope(y, v, spring)
    dy2, dv2 = slope(y + dt * dy1, v + dt * dv1, spring)
    y = y + dt * (dy1 + dy2) / 2
    v = v + dt * (dv1 + dv2)
    return y, v
