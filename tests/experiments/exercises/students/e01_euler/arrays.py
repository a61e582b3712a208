import numpy as np

EXERCISE = 1


def step(y, v, dt, spring):
    m, k, c = spring.mass, spring.stiffness, spring.damping
    g = spring.gravity
    matrix = np.array([[0.0, 1.0], [-k / m, -c / m]])
    constant = np.array([0.0, -k * spring.rest_length / m - g])
    state = np.array([y, v])
    slope = matrix @ state + constant
    new = state + dt * slope
    return new[0], new[1]
