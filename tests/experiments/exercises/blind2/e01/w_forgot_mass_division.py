EXERCISE = 1


def step(y, v, dt, spring):
    spring_force = spring.stiffness * (-y - spring.rest_length)
    gravity_force = -spring.gravity * spring.mass
    damping_force = -spring.damping * v
    force = spring_force + gravity_force + damping_force
    return y + v * dt, v + force * dt
