EXERCISE = 1


def step(y, v, dt, spring):
    length = -y
    pull = spring.stiffness * (length - spring.rest_length)
    weight = spring.mass * spring.gravity
    damping = spring.damping * v
    total = pull - weight + damping
    a = total / spring.mass
    new_y = y + dt * v
    new_v = v + dt * a
    return new_y, new_v
