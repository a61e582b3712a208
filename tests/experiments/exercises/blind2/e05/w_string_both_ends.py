import math

EXERCISE = 5
SEED = "example"
M = 0.026
K = 474.8
C = 0.229
N = 3


def omega():
    return math.sqrt(K / M)


def kick_drift():
    return 2 / omega()


def runge_kutta():
    return math.sqrt(8) / omega()


def euler():
    return C / K


def string():
    fastest = 2 * omega() * math.sin(N * math.pi / (2 * (N + 1)))
    return 2 / fastest
