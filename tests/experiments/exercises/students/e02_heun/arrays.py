import numpy as np

EXERCISE = 2


def step(y, v, dt, spring):
    def f(z):
        force = -spring.stiffness * (z[0] + spring.rest_length) - spring.damping * z[1]
        return np.array([z[1], force / spring.mass - spring.gravity])

    z = np.array([y, v])
    s1 = f(z)
    guess = z + dt * s1
    s2 = f(guess)
    z = z + dt * 0.5 * (s1 + s2)
    return z
