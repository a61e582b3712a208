EXERCISE = 2


def f(y, v, spring):
    k, m = spring.stiffness, spring.mass
    return k / m * (-y - spring.rest_length) - spring.gravity - spring.damping / m * v


def step(y, v, dt, spring):
    vg = v + f(y, v, spring) * dt
    yg = y + v * dt
    y_next = y + dt * (v + vg / 2)
    v_next = v + dt * (f(y, v, spring) + f(yg, vg, spring)) / 2
    return y_next, v_next
