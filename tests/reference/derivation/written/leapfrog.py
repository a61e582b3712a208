def step(a, x, v, dt):
    half = v + a(x, v) * dt / 2
    x = x + half * dt
    return x, half + a(x, half) * dt / 2
