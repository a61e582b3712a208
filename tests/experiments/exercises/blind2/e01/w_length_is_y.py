EXERCISE = 1


def step(y, v, dt, spring):
    stretch = y - spring.rest_length
    f = spring.stiffness * stretch - spring.mass * spring.gravity - spring.damping * v
    return y + v * dt, v + f / spring.mass * dt
