from functools import reduce
from operator import add

EXERCISE = 1

FORCES = (
    lambda y, v, s: s.stiffness * (abs(y) - s.rest_length),
    lambda y, v, s: -(s.gravity * s.mass),
    lambda y, v, s: -(v * s.damping),
)


def step(y, v, dt, spring):
    total = reduce(add, (f(y, v, spring) for f in FORCES))
    (y, v) = (y + v * dt, v + total * dt / spring.mass)
    return y, v
