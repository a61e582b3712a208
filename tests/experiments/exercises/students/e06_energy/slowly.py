EXERCISE = 6
import math


def lengths(x, s):
    previous = tuple(s.anchor)
    for p in x:
        yield math.dist(previous, p)
        previous = tuple(p)


def energy(x, v, string):
    T = math.fsum(m * math.hypot(*u) ** 2 for m, u in zip(string.masses, v)) / 2
    U = math.fsum(k * (l - l0) ** 2 for k, l, l0 in zip(string.stiffness, lengths(x, string), string.rest_lengths)) / 2
    V = math.fsum(m * string.gravity * h for m, (_, h) in zip(string.masses, x))
    return [T, U, V]


def power(x, v, string):
    # the rate of a length: a little later less a little earlier
    h = 1e-6
    later, earlier = list(lengths(x + h * v, string)), list(lengths(x - h * v, string))
    loss = sum(c * ((a - b) / (2 * h)) ** 2 for c, a, b in zip(string.damping, later, earlier))
    return -loss - string.drag * sum(math.hypot(*u) ** 2 for u in v)
