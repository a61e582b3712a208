from math import pi, sin, sqrt

EXERCISE = 5
SEED = "example"

M, K, C, N = 0.026, 474.8, 0.229, 3
RATE = sqrt(K / M)


def kick_drift():
    return 2 / RATE


def runge_kutta():
    return round(2 * sqrt(2) / RATE, 6)


def euler():
    return C / K


def string():
    return 1 / (RATE * sin((2 * N - 1) * pi / (4 * N + 2)))
