EXERCISE = 1


def step(y, v, dt, spring):
    force = spring.stiffness * (-y - spring.rest_length) - spring.mass * spring.gravity - spring.damping * v
    return y + dt * v, v + dt * force / spring.mass
