EXERCISE = 1
step = lambda y, v, dt, s: (
    y + v * dt,
    v + dt * ((s.stiffness * (-s.rest_length - y) - s.damping * v) / s.mass - s.gravity),
)
