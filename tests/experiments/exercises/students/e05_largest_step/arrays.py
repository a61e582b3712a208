"""Largest stable steps by bisection on the eigenvalues of the step's matrix."""

import numpy as np

EXERCISE = 5
SEED = "example"
MASS, STIFFNESS, DAMPING, MASSES = 0.026, 474.8, 0.229, 3


def slope_matrix(damping):
    return np.array([[0, 1], [-STIFFNESS / MASS, -damping / MASS]])


def kick_drift_matrix(h):
    w2 = STIFFNESS / MASS
    return np.array([[1 - h**2 * w2, h], [-h * w2, 1]])


def runge_kutta_matrix(h):
    A = h * slope_matrix(0)
    I = np.eye(2)
    return I + A @ (I + A / 2 @ (I + A / 3 @ (I + A / 4)))


def euler_matrix(h):
    return np.eye(2) + h * slope_matrix(DAMPING)


def string_matrix(h):
    K = STIFFNESS * (2 * np.eye(MASSES) - np.eye(MASSES, k=1) - np.eye(MASSES, k=-1))
    K[-1, -1] = STIFFNESS
    I = np.eye(MASSES)
    W = K / MASS
    return np.block([[I - h**2 * W, h * I], [-h * W, I]])


def bisect(matrix, low=1e-6, high=1.0):
    for _ in range(60):
        middle = (low + high) / 2
        if np.abs(np.linalg.eigvals(matrix(middle))).max() > 1 + 1e-7:
            high = middle
        else:
            low = middle
    return low


def kick_drift():
    return bisect(kick_drift_matrix)


def runge_kutta():
    return bisect(runge_kutta_matrix)


def euler():
    return bisect(euler_matrix)


def string():
    return bisect(string_matrix)
