def step(a, x, v, dt):
    here = a(x, v)
    new = x + dt * v + dt**2 * here
    return new, v + dt / 2 * (here + a(new, v + dt * here))
