EXERCISE = 1


def step(y, v, dt, spring):
    from fractions import Fraction as D

    y, v, dt = D(float(y)), D(float(v)), D(float(dt))
    m, k, c = map(lambda q: D(float(q)), (spring.mass, spring.stiffness, spring.damping))
    L0, g = D(float(spring.rest_length)), D(float(spring.gravity))
    stretch = -y - L0
    F = k * stretch - c * v - m * g
    a = F / m
    y_new = y + dt * v
    v_new = v + dt * a
    return float(y_new), float(v_new)
