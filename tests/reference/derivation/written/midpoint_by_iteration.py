def step(f, y, t, h):
    k = f(y, t)
    for _ in range(60):
        k = f(y + h / 2 * k, t + h / 2)
    return y + h * k
