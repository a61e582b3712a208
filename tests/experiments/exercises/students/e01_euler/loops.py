EXERCISE = 1


def step(y, v, dt, spring):
    # the spring
    length = -y
    stretch = length - spring.rest_length
    force = spring.stiffness * stretch
    # weight
    force -= spring.mass * spring.gravity
    # friction
    force -= spring.damping * v
    a = force / spring.mass
    y_new = y + dt * v
    v_new = v + dt * a
    return y_new, v_new
