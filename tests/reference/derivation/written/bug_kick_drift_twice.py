def step(x, v, dt, system):
    v = v + 2 * dt * system.acceleration(x, v)
    return x + dt * v, v
