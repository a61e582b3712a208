EXERCISE = 1


def step(y, v, dt, spring):
    stretch = spring.rest_length + y
    f = spring.stiffness * stretch + spring.mass * spring.gravity - spring.damping * v
    return y + dt * v, v + dt * f / spring.mass
