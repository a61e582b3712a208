import numpy as np

EXERCISE = 2


def step(y, v, dt, spring):
    state = np.array([y, v])

    def f(s):
        F = spring.stiffness * (abs(s[0]) - spring.rest_length) - spring.damping * s[1]
        return np.array([s[1], F / spring.mass - spring.gravity])

    k1 = f(state)
    k2 = f(state + k1 * dt)
    return state + (k1 + k2) * dt / 2
