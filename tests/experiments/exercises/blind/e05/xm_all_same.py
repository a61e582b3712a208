from math import sqrt, sin, pi

EXERCISE = 5
SEED = "example"
m, k, c, n = 0.026, 474.8, 0.229, 3
w = sqrt(k / m)


def kick_drift():
    return 2 / w


def runge_kutta():
    return 2 / w


def euler():
    return 2 / w


def string():
    return 2 / w
