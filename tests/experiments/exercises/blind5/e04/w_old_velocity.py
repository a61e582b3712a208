"""Exercise 4: a string by Heun's step, the whole state at once. Run me: python whole_state.py."""

from types import SimpleNamespace

import numpy as np

EXERCISE = 4


def spring_pulls(x, string):
    pulls = []
    last = string.anchor
    for point, k, rest in zip(x, string.stiffness, string.rest_lengths):
        e = point - last
        size = np.linalg.norm(e)
        pulls.append(k * (size - rest) / size * e)
        last = point
    return pulls


def accelerations(x, v, string):
    pulls = spring_pulls(x, string)
    result = np.empty_like(x)
    for i, m in enumerate(string.masses):
        total = -pulls[i] - string.drag * v[i]
        if i < len(pulls) - 1:
            total = total + pulls[i + 1]
        result[i] = total / m - np.array([0, string.gravity])
    return result


def step(x, v, dt, string):
    """From positions x [m] and velocities v [m/s], shape (n, 2), those after dt [s]."""
    a = accelerations(x, v, string)
    x_guess, v_guess = x + v * dt, v + a * dt
    a_guess = accelerations(x_guess, v, string)
    return x + (v + v_guess) * dt / 2, v + (a + a_guess) * dt / 2


if __name__ == "__main__":
    string = SimpleNamespace(
        masses=np.full(3, 0.05),
        stiffness=np.full(3, 50.0),
        rest_lengths=np.full(3, 0.15),
        drag=0.02,
        gravity=9.81,
        anchor=np.array([0.1, 0.2]),
    )
    x = string.anchor + np.array([[0.15, 0.0], [0.3, 0.0], [0.45, 0.0]])
    v = np.zeros((3, 2))
    for i in range(10):
        print(f"t = {0.005 * i:.3f} s   the last mass is at {x[-1]} m")
        x, v = step(x, v, 0.005, string)
