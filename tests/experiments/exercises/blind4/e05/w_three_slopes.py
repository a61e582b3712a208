"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

import numpy as np

EXERCISE = 5
SEED = "ada"


mass, stiffness, damping, masses = 0.158, 196.7, 0.115, 3
A = np.array([[0, 1], [-stiffness / mass, 0]])
I = np.eye(2)


def scan(step_matrix, dts):
    """The last dt of a fine scan at which nothing has grown yet."""
    good = 0.0
    for dt in dts:
        if max(abs(np.linalg.eigvals(step_matrix(dt)))) > 1 + 1e-9:
            break
        good = dt
    return good


def kick_drift():
    """The largest stable dt [s] of kick-drift, one mass without damping."""

    def mat(h):
        return np.array([[1 - h * h * stiffness / mass, h], [-h * stiffness / mass, 1]])

    return scan(mat, np.arange(0.001, 0.2, 1e-5))


def runge_kutta():
    """The largest stable dt [s] of classic Runge-Kutta, one mass without damping."""

    def mat(h):
        B = h * A
        return I + B + B @ B / 2 + B @ B @ B / 6

    return scan(mat, np.arange(0.001, 0.2, 1e-5))


def euler():
    """The largest stable dt [s] of Euler, one mass with damping."""
    D = np.array([[0, 1], [-stiffness / mass, -damping / mass]])
    return scan(lambda h: I + h * D, np.arange(1e-6, 0.01, 5e-7))


def string():
    """The largest stable dt [s] of kick-drift, a string."""
    return 1 / (np.sqrt(stiffness / mass) * np.sin(np.pi / 2 * (2 * masses - 1) / (2 * masses + 1)))


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
