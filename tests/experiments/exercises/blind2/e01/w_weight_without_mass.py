EXERCISE = 1


def force(y, v, spring):
    up = spring.stiffness * (-y - spring.rest_length)
    down = spring.gravity
    return up - down - spring.damping * v


def step(y, v, dt, spring):
    a = force(y, v, spring) / spring.mass
    return y + dt * v, v + dt * a
