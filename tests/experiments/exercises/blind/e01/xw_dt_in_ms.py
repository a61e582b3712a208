EXERCISE = 1


def step(y, v, dt, spring):
    m, k, c = spring.mass, spring.stiffness, spring.damping
    L0, g = spring.rest_length, spring.gravity
    dt = dt / 1000
    stretch = -y - L0
    F = k * stretch - c * v - m * g
    a = F / m
    y_new = y + dt * v
    v_new = v + dt * a
    return y_new, v_new
