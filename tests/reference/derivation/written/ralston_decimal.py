def step(f, y, t, dt):
    k1 = f(t, y)
    k2 = f(t + dt * 0.6666666666666666, y + dt * 0.6666666666666666 * k1)
    return y + dt * (0.25 * k1 + 0.75 * k2)
