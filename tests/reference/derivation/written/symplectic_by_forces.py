def step(x, v, dt, system):
    v_new = v + dt * system.forces(x, v) / system.masses[:, None]
    x_new = x + dt * v_new
    return x_new, v_new
