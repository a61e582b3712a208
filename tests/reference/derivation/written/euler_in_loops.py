def step(f, y, t, dt):
    slope = f(y, t)
    new = y.copy()
    for i in range(len(y)):
        new[i] = y[i] + dt * slope[i]
    return new
