from math import hypot

EXERCISE = 6


def springs(x, v, s):
    for i in range(len(x)):
        ax, ay = s.anchor if i == 0 else x[i - 1]
        au, aw = (0, 0) if i == 0 else v[i - 1]
        length = hypot(x[i][0] - ax, x[i][1] - ay)
        rate = ((x[i][0] - ax) * (v[i][0] - au) + (x[i][1] - ay) * (v[i][1] - aw)) / length
        yield i, length - s.rest_lengths[i], rate


def energy(x, v, s):
    kinetic = sum(0.5 * m * (u[0] ** 2 + u[1] ** 2) for m, u in zip(s.masses, v))
    elastic = sum(0.5 * s.stiffness[i] * stretch**2 for i, stretch, _ in springs(x, v, s))
    return [kinetic, elastic, sum(m * s.gravity * place[1] for m, place in zip(s.masses, x))]


def power(x, v, s):
    lost = sum(s.damping[i] * rate**2 for i, _, rate in springs(x, v, s))
    return -(lost + sum(s.drag * (u @ u) for u in v))
