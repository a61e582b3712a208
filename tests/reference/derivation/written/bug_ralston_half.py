def step(f, y, t, dt):
    k1 = f(y, t)
    k2 = f(y + dt / 2 * k1, t + dt / 2)
    return y + dt * (k1 + 3 * k2) / 4
