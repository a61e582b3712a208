EXERCISE = 2


def acc(y, v, spring):
    stretch = -y - spring.rest_length
    return (spring.stiffness * stretch - spring.damping * v) / spring.mass - spring.gravity


def step(y, v, dt, spring):
    # slope here
    k1y = v
    k1v = acc(y, v, spring)
    # Euler guess
    yg = y + dt * k1y
    vg = v + dt * k1v
    # slope there
    k2y = vg
    k2v = acc(yg, vg, spring)
    y1 = y + dt * (k1y + k2y) / 2
    v1 = v + dt * (k1v + k2v) / 2
    return y1, v1
