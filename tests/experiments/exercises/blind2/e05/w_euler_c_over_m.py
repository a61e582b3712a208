EXERCISE = 5
SEED = "example"
from math import cos, pi, sqrt

MASS, STIFFNESS, DAMPING, MASSES = 0.026, 474.8, 0.229, 3


def kick_drift():
    return 2 * sqrt(MASS / STIFFNESS)


def runge_kutta():
    return 2.828 * sqrt(MASS / STIFFNESS)


def euler():
    return 2 * MASS / DAMPING


def string():
    return sqrt(MASS / STIFFNESS) / cos(pi / (4 * MASSES + 2))
