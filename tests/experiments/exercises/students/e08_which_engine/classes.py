EXERCISE = 8
SEED = "example"

found = {}
found["D"] = "heun"
found["B"] = "kick_drift"
found["C"] = "drift_kick"
found["E"] = "velocity_verlet"
found["A"] = "rk4"


def names():
    return tuple(found[letter] for letter in sorted(found))
