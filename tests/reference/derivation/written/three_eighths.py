def step(f, y, t, h):
    a = f(y, t)
    b = f(y + h * a / 3, t + h / 3)
    c = f(y + h * (b - a / 3), t + 2 * h / 3)
    d = f(y + h * (a - b + c), t + h)
    return y + h * (a + 3 * b + 3 * c + d) / 8
