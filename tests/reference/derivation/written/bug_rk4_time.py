def step(f, y, t, h):
    k1 = f(y, t)
    k2 = f(y + h / 2 * k1, t)
    k3 = f(y + h / 2 * k2, t)
    k4 = f(y + h * k3, t)
    return y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
