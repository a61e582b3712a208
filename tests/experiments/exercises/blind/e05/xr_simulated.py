from math import sqrt, sin, pi

EXERCISE = 5
SEED = "example"
m, k, c, n = 0.026, 474.8, 0.229, 3
w = sqrt(k / m)


def kick_drift():
    lo, hi = 1e-4, 1.0
    for _ in range(40):
        h = (lo + hi) / 2
        y, u = 1.0, 0.0
        for i in range(3000):
            u -= h * k / m * y
            y += h * u
            if abs(y) > 100:
                break
        if abs(y) > 100:
            hi = h
        else:
            lo = h
    return lo


def runge_kutta():
    return 2 * sqrt(2) / w


def euler():
    return c / k


def string():
    return 1 / (w * sin((2 * n - 1) * pi / (4 * n + 2)))
