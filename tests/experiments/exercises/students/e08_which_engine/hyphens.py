# the names as they are in books
EXERCISE = 8
SEED = "example"


def names():
    return ["RK4", "Kick-drift", "Drift kick", "Heun", "velocity Verlet"]
