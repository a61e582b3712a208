from collections import namedtuple

EXERCISE = 1
State = namedtuple("State", "y v")


def terms(s, p):
    yield p.stiffness * (-s.y - p.rest_length)
    yield -p.mass * p.gravity
    yield -p.damping * s.v


def step(y, v, dt, spring):
    s = State(y, v)
    total = 0.0
    for t in terms(s, spring):
        total = total + t
    return State(s.y + dt * s.v, s.v + dt * total / spring.mass)
