from math import hypot

EXERCISE = 6


def energy(x, v, string):
    kinetic = 0.0
    elastic = 0.0
    weight = 0.0
    for i in range(len(x)):
        m = string.masses[i]
        kinetic += 0.5 * m * (v[i][0] ** 2 + v[i][1] ** 2)
        weight += m * string.gravity * x[i][1]
        if i == 0:
            above = string.anchor
        else:
            above = x[i - 1]
        length = hypot(x[i][0] - above[0], x[i][1] - above[1])
        stretch = length - string.rest_lengths[i]
        elastic += 0.5 * string.stiffness[i] * stretch**2
    return kinetic, elastic, weight


def power(x, v, string):
    P = 0.0
    for i in range(len(x)):
        P -= string.drag * (v[i][0] ** 2 + v[i][1] ** 2)
        if i == 0:
            above = string.anchor
            vx, vy = v[0]
        else:
            above = x[i - 1]
            vx = v[i][0] - v[i - 1][0]
            vy = v[i][1] - v[i - 1][1]
        dx = x[i][0] - above[0]
        dy = x[i][1] - above[1]
        rate = (vx * dx + vy * dy) / hypot(dx, dy)
        P -= string.damping[i] * rate**2
    return P
