EXERCISE = 5
SEED = "example"

from math import cos, pi, sqrt

m = 0.026
k = 474.8
c = 0.229
n = 3


def kick_drift():
    w = sqrt(k / m)
    return 2 / w


def runge_kutta():
    w = sqrt(k / m)
    return 2 * sqrt(2) / w


def euler():
    # complex eigenvalues: |1 + h lambda| = 1
    return c / k


def string():
    w_max = 2 * sqrt(k / m) * cos(pi / (2 * n + 1))
    return 2 / w_max
