from math import dist

EXERCISE = 4


def pulls(x, s):
    out = []
    for i, (a, b) in enumerate(zip([list(s.anchor), *x], x)):
        far = dist(a, b)
        out.append([s.stiffness[i] * (far - s.rest_lengths[i]) * (p - q) / far for p, q in zip(a, b)])
    return out


def acc(x, v, s):
    t = pulls(x, s) + [[0.0, 0.0]]
    g = (0.0, s.gravity)
    return [[(t[i][c] - t[i + 1][c] - s.drag * v[i][c]) / s.masses[i] - g[c] for c in (0, 1)] for i in range(len(x))]


def add(x, f, y):
    return [[p + f * q for p, q in zip(a, b)] for a, b in zip(x, y)]


def step(x, v, dt, s):
    x, v = x.tolist(), v.tolist()
    a = acc(x, v, s)
    x1, v1 = add(x, dt, v), add(v, dt, a)
    b = acc(x1, v1, s)
    return add(add(x, dt / 2, v), dt / 2, v1), add(add(v, dt / 2, a), dt / 2, b)
