def step(x, v, acc, h):
    x = x + h / 2 * v
    v = v + h * acc(x, v)
    return x + h / 2 * v, v
