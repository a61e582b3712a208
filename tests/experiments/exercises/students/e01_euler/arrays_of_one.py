import numpy as np

EXERCISE = 1


def step(y, v, dt, spring):
    state = np.array([[y], [v]])
    A = np.array([[0, 1], [-spring.stiffness / spring.mass, -spring.damping / spring.mass]])
    b = np.array([[0], [-spring.stiffness * spring.rest_length / spring.mass - spring.gravity]])
    return state + dt * (A @ state + b)
