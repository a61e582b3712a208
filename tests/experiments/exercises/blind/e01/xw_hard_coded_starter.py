EXERCISE = 1


def step(y, v, dt, spring):
    m, k, c = 0.05, 50.0, 0.0
    L0, g = 0.15, 9.81
    stretch = -y - L0
    F = k * stretch - c * v - m * g
    a = F / m
    y_new = y + dt * v
    v_new = v + dt * a
    return y_new, v_new
