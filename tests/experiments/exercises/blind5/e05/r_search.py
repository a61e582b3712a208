"""Exercise 5: the largest stable step. My numbers are in parameters.json. Run me: python largest_step.py."""

import numpy as np

EXERCISE = 5
SEED = "example"

m, k, c, n = 0.026, 474.8, 0.229, 3


def radius(M):
    return max(abs(np.linalg.eigvals(M)))


def limit(matrix, low=1e-7, high=1.0):
    """Largest dt where matrix(dt) has no eigenvalue above 1, by halving (it is unstable from there on)."""
    for _ in range(60):
        middle = (low + high) / 2
        if radius(matrix(middle)) > 1 + 1e-9:
            high = middle
        else:
            low = middle
    return low


def generator(damping):
    return np.array([[0.0, 1.0], [-k / m, -damping / m]])


def kick_drift():
    w2 = k / m
    return limit(lambda h: np.array([[1 - h * h * w2, h], [-h * w2, 1.0]]))


def runge_kutta():
    I = np.eye(2)

    def step(h):
        Z = h * generator(0.0)
        return I + Z @ (I + Z / 2 @ (I + Z / 3 @ (I + Z / 4)))

    # at tiny h rounding hides the shrinking, so I ask the other way round: start where it matters
    return limit(step, 1e-3, 0.1)


def euler():
    return limit(lambda h: np.eye(2) + h * generator(c))


def string():
    K = 2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1)
    K[-1, -1] = 1
    W = K * k / m
    I = np.eye(n)
    return limit(lambda h: np.block([[I - h * h * W, h * I], [-h * W, I]]))


if __name__ == "__main__":
    for function in (kick_drift, runge_kutta, euler, string):
        print(f"{function.__name__}: {function():.4g} s")
