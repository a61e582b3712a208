from math import sqrt, sin, pi

EXERCISE = 5
SEED = "example"
m, k, c, n = 0.026, 474.8, 0.229, 3
w = sqrt(k / m)


def kick_drift():
    return 1.004 * 2 / w


def runge_kutta():
    return 2 * sqrt(2) / w


def euler():
    return c / k


def string():
    return 1 / (w * sin((2 * n - 1) * pi / (4 * n + 2)))
