def step(f, y, t, dt):
    y1 = y + dt * f(y, t)
    y2 = 3 / 4 * y + 1 / 4 * (y1 + dt * f(y1, t + dt))
    return 1 / 3 * y + 2 / 3 * (y2 + dt * f(y2, t + dt / 2))
