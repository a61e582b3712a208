import numpy as np

EXERCISE = 8
SEED = "example"
NAMES = np.array(
    ["euler", "heun", "kick_drift", "drift_kick", "velocity_verlet", "midpoint", "rk4", "heun_link_by_link"]
)
FOUND = [6, 2, 3, 1, 4]


def names():
    return list(NAMES[FOUND])
