EXERCISE = 8
SEED = "example"


def names():
    return ["rk4", "kick_drift", "drift_kick", "heun", "velocity_verlet"]
