EXERCISE = 5
SEED = "example"
m, k, c, n = 0.026, 474.8, 0.229, 3
import math

w = math.sqrt(k / m)


def kick_drift():
    return 1 / w


def runge_kutta():
    return 2 * math.sqrt(2) / w


def euler():
    return c / k


def string():
    return 2 / (2 * w * math.cos(math.pi / (2 * (2 * n + 1))))
