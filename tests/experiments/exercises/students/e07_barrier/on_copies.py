from copy import deepcopy

EXERCISE = 7


def push_out(x, v, circle):
    x, v = deepcopy(x), v.copy()
    for p, u in zip(x, v):
        p -= circle.centre
        square = p @ p
        if square < circle.radius**2:
            inwards = min(0.0, u @ p)
            u -= inwards / square * p
            p *= circle.radius / square**0.5
        p += circle.centre
    return [x.tolist(), v.tolist()]
