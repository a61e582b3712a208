EXERCISE = 1


def step(y, v, dt, spring):
    F = spring.stiffness * (-y - spring.rest_length) - spring.mass * spring.gravity - spring.damping * v
    v += F / spring.mass * dt
    y += v * dt
    return y, v
