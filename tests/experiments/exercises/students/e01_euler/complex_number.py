EXERCISE = 1


def step(y, v, dt, spring):
    z = complex(y, v)
    rest = -spring.rest_length - spring.mass * spring.gravity / spring.stiffness
    pull = (spring.stiffness * (rest - z.real) - spring.damping * z.imag) / spring.mass
    z += dt * complex(z.imag, pull)
    return [z.real, z.imag]
